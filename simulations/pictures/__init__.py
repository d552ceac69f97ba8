"""Pictures drawn by our own models, in linear light: nothing photographed, nothing borrowed."""
