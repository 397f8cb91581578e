"""Pictures of real models: `show.py` is what `build_addon.py demo` does."""
