"""Functions of parameters with their gradients, for optimisers: of NumPy and SciPy, JAX, PyTorch; see `nivel.api.Machine.gradient`.

f = value_and_gradient(machine, "max(rod.position.y)", ["bodies.rod.mass", "parameters.length"], duration=0.5)
scipy.optimize.minimize(f, [2.0, 0.5], jac=True)
"""

from collections.abc import Callable, Sequence
from typing import Any, Unpack

import numpy as np
from numpy.typing import ArrayLike

from nivel.api import Machine
from nivel.errors import Fault, ModelError
from nivel.extras import needed
from nivel.machine.core.vectors import Array
from nivel.settings import RunSettingsDict


def value_and_gradient(
    machine: Machine, output: str, parameters: Sequence[str], **settings: Unpack[RunSettingsDict]
) -> Callable[[ArrayLike], tuple[float, Array]]:
    """f(x) → (value, slopes (n,)) of one output for values x (n,) of the parameters [SI units].

    settings : as of `Machine.simulate`. f raises ModelError where a value is not possible, SolveError where a run fails. Slopes are not
    checked by further runs: see `Machine.gradient` for that.
    """
    evaluate = _values_and_slopes(machine, [output], parameters, settings)

    def of(x: ArrayLike) -> tuple[float, Array]:
        values, slopes = evaluate(np.asarray(x, dtype=float))
        return float(values[0]), slopes[0]

    return of


def jax_function(
    machine: Machine, outputs: Sequence[str], parameters: Sequence[str], **settings: Unpack[RunSettingsDict]
) -> Callable[[Any], Any]:
    """f(x (n,)) → outputs (m,) for JAX, with a gradient (`jax.custom_vjp`) by the run that gives the values; `jit` and `grad` take it.

    Numbers are as exact as the arrays are: `jax.config.update("jax_enable_x64", True)` for double precision. Raises ModelError where JAX is
    not installed; f as that of `value_and_gradient`.
    """
    jax: Any = needed("jax", "gradients in JAX need")
    evaluate = _values_and_slopes(machine, outputs, parameters, settings)

    def both(x: Any) -> tuple[Any, Any]:
        shapes = (
            jax.ShapeDtypeStruct((len(outputs),), x.dtype),
            jax.ShapeDtypeStruct((len(outputs), len(parameters)), x.dtype),
        )
        return jax.pure_callback(
            lambda y: tuple(each.astype(x.dtype) for each in evaluate(np.asarray(y, float))), shapes, x
        )

    @jax.custom_vjp
    def f(x: Any) -> Any:
        return both(x)[0]

    f.defvjp(both, lambda slopes, weights: (weights @ slopes,))
    return f


def torch_function(
    machine: Machine, outputs: Sequence[str], parameters: Sequence[str], **settings: Unpack[RunSettingsDict]
) -> Callable[[Any], Any]:
    """f(x (n,)) → outputs (m,) for PyTorch, with a gradient (`torch.autograd.Function`) by the run that gives the values.

    Raises ModelError where PyTorch is not installed; f as that of `value_and_gradient`.
    """
    torch: Any = needed("torch", "gradients in PyTorch need")
    evaluate = _values_and_slopes(machine, outputs, parameters, settings)

    class Run(torch.autograd.Function):
        @staticmethod
        def forward(ctx: Any, x: Any) -> Any:
            values, slopes = evaluate(x.detach().cpu().double().numpy())
            ctx.save_for_backward(torch.as_tensor(slopes, dtype=x.dtype, device=x.device))
            return torch.as_tensor(values, dtype=x.dtype, device=x.device)

        @staticmethod
        def backward(ctx: Any, *weights: Any) -> Any:
            (slopes,) = ctx.saved_tensors
            return weights[0] @ slopes

    return Run.apply


def _values_and_slopes(
    machine: Machine, outputs: Sequence[str], parameters: Sequence[str], settings: RunSettingsDict
) -> Callable[[Array], tuple[Array, Array]]:
    """Outputs (m,) and slopes (m, n) of a run with these values of the parameters; those of the last one are kept."""
    kept: dict[bytes, tuple[Array, Array]] = {}

    def evaluate(x: Array) -> tuple[Array, Array]:
        if x.shape != (len(parameters),):
            message = f"{len(parameters)} values are needed, one for each parameter; there are {x.shape}"
            raise ModelError(Fault.at("x", message))
        if x.tobytes() not in kept:
            values = dict(zip(parameters, map(float, x), strict=True))
            found = machine.with_values(values).gradient(outputs, parameters, check=False, **settings)
            slopes = [[_number(found[f"d({output})/d({each})"], output) for each in parameters] for output in outputs]
            kept.clear()
            kept[x.tobytes()] = np.array([_number(found[output], output) for output in outputs]), np.array(slopes)
        return kept[x.tobytes()]

    return evaluate


def _number(value: Any, output: str) -> float:
    if value.size != 1:
        message = (
            f"`{output}` is an array of shape {value.shape}; a function of an optimiser needs numbers, as `{output}.x`"
        )
        raise ModelError(Fault.at(output, message))
    return float(value.item())
