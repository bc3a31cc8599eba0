"""The diagram of hydraulic and pneumatic circuits: symbols of ISO 1219-1 in rows from actuators down to pumps, lines between them in
channels.

`parts` reads a machine, `placing` puts its parts into rows and columns, `routing` lays lines and labels, `drawing` writes the SVG. Symbols
are those of each `nivel.elements.circuits.kind.ComponentKind`.
"""
