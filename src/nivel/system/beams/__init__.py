"""Arrays of beams: nodes, elements, segments, tangents."""
