"""Points, meshes and axes as files; docs/formats.md describes them."""
