"""The diagram of hydraulic and pneumatic circuits: symbols of ISO 1219-1 in rows from actuators down to pumps, lines between them in
channels.

`parts` reads a machine, `symbols` draws its components, `placing` puts them into rows and columns, `routing` lays lines and labels,
`drawing` writes the SVG.
"""
