"""Authors' code, run in a pool of processes with one limit of time."""
