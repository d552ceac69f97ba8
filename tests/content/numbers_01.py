"""Chapter 1: transformations of the plane."""

CHAPTER = "01-2d-transformations"


WORKED = ()
