"""What the method needs of the machine: the compiled module, memory, threads, progress."""
