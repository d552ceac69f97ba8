"""What the book on waves has: its scenes and ladders, each id to its module."""

SCENES = {
    name.replace("_", "-"): f"simulations.scenes.{name}.scene"
    for name in ("leakage", "standing_waves", "wave_packet")
}
LADDERS = {"tone-frequency": "simulations.ladders.tone_frequency"}
