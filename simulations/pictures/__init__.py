"""Pictures drawn by the models, in linear light, without photographs."""
