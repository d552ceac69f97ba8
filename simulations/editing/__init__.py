"""A figure's own copy of the program, with definitions that its reader has rewritten."""
