"""From paper to bench: a device in millimetres and seconds, and whether the model holds for it."""
