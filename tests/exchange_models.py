"""Models of other programs for tests."""

INERTIA = '<inertia ixx="{0}" ixy="0" ixz="0" iyy="{1}" iyz="0" izz="{2}"/>'


def link(name, mass=None, at="0 0 0", inertia=(0.1, 0.2, 0.3), more="", rpy="0 0 0"):
    """A link of a URDF, without `mass` a bare frame."""
    if mass is None:
        return f'<link name="{name}">{more}</link>'
    inertial = f'<inertial><origin xyz="{at}" rpy="{rpy}"/><mass value="{mass}"/>{INERTIA.format(*inertia)}</inertial>'
    return f'<link name="{name}">{inertial}{more}</link>'


def joint(name, kind, parent, child, at="0 0 0", axis="0 1 0", more="", rpy="0 0 0"):
    """A joint of a URDF."""
    bodies = f'<parent link="{parent}"/><child link="{child}"/>'
    return (
        f'<joint name="{name}" type="{kind}">{bodies}<origin xyz="{at}" rpy="{rpy}"/><axis xyz="{axis}"/>{more}</joint>'
    )


def robot(*elements, name="robot"):
    """A URDF, an element in each line."""
    return "\n".join([f'<robot name="{name}">', *elements, "</robot>"]) + "\n"
