"""Many axes, one after the other: names of files, frames, stamps, and options as words."""
