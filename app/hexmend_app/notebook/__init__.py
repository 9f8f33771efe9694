"""Pictures of meshes for notebooks; joined through the entry-point group `hexmend.pictures`."""
