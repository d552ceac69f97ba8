"""Formulae: TeX to MathML, by Temml under Node."""
