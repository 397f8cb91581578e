"""The method for Python, without Blender: settings, analysis, files."""
