"""The builder goes first: it says whose ``simulations`` are found."""

import site_builder as site_builder
