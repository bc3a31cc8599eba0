"""The viewer: results played back, machines moved by hand, and later machines while they run, in one page that needs no network.

=================  ====================================================================================================
``records``        what server and page say to each other; ``typescript`` writes the same for the page
``stage``          what is drawn: bodies with their parts, joints, flexible meshes
``acting``         forces and drivers; ``couplings`` gears, belts, racks; ``sweeps`` beams; ``arrows`` what acts, as vectors
``frames``         one packed array a moment: poses, modal coordinates, arrows
``package``        a stage with its whole motion in one block of bytes
``playback``       the package of a result
``page``           the built page, alone or with a package inside: one file that opens anywhere
``server``         the page and its packages over a local address; ``stream`` sends frames, newest only, one in flight
``capture``        pictures and films through the page in a browser
=================  ====================================================================================================
"""
