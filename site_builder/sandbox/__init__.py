"""Authors' code: imported and run in processes with limits, without files and network."""
