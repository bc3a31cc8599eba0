"""Linear equations of motion about a state, as the result of an analysis: matrices with names, eigenvalues, frequency response."""

import json
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.extras import needed
from nivel.files.target import write_page
from nivel.known import Inline, Result
from nivel.lazy import Struct, field, nivel, provided, scipy, xarray
from nivel.machine.core.vectors import Array, Complex
from nivel.results.analyses.sampled_model import SampledModel, participation, taking_part
from nivel.results.frames.tabulated import Column, Rows, Tabulated, chosen
from nivel.results.trust import Trust

ROUND_OFF: Final = 1e-11  # share of an eigenvalue below which its real part is nothing, however well it is known
FREQUENCIES: Final = 400
LISTED: Final = 12  # modes in a text


class Mode(Struct):
    """An eigenvalue [1/s], or a pair of complex ones by that with the positive imaginary part.

    natural_frequency [Hz] : |λ|/2π. damping_ratio : -Re λ/|λ|, not a number for λ = 0. structural : exactly zero, whatever the numbers of
    the machine. participation : (name, share) of the states that take part most. unresolved : what makes it wrong, in words: elements of
    beams, or modes of a flexible body; empty where nothing is known against it. round_off [1/s] : to how much the eigenvalue is known.
    """

    number: int
    eigenvalue: complex
    natural_frequency: float
    damping_ratio: float
    structural: bool
    participation: tuple[tuple[str, float], ...]
    unresolved: str = ""
    round_off: float = 0.0

    @property
    def kind(self) -> str:
        """What the motion does, in words."""
        if self.structural:
            return "exactly zero"
        value = self.eigenvalue
        if abs(value.real) <= max(self.round_off, ROUND_OFF * abs(value)):
            return "undamped vibration"
        if value.imag:
            return "damped vibration" if value.real < 0.0 else "vibration that grows"
        return "decays" if value.real < 0.0 else "grows"

    @property
    def number_in_words(self) -> str:
        """The eigenvalue for people, a real part of round-off left out."""
        value = self.eigenvalue
        if self.structural:
            return "0, exactly"
        if not value.imag:
            return f"{value.real:.6g}"
        return f"± {value.imag:.6g}i" if self.kind == "undamped vibration" else f"{value.real:.6g} ± {value.imag:.6g}i"


class LinearModel(Struct, Tabulated):
    """δẋ = A δx + B δu, δy = C δx + D δu about a state of a machine at `time` [s].

    states, inputs, outputs : names; *_units : their units. M, damping, K (m, m) : Zᵀ M Z, Zᵀ D Z and Zᵀ K Z in the independent
    coordinates; at rest these are the second-order equations. eigenvalues (n,) : in the order of `modes`, but both of each pair; no numbers
    where the machine does not move steadily. round_off (n,) : to how much they are known [1/s].
    steady : whether eigenvalues describe the motion (at rest, or the same A later on). no_modes : why they do not, and what to do; empty
    where they do. remarks : on what the states are. trust : the trust report.
    right, left (n, n) : eigenvectors, a column each. shift, turn (n, B, 3) : of body frames in each, complex.
    sampled : the machine with its sampled controllers, None without any; A and its eigenvalues are those between samples.
    random : the response to spectra that was asked for, as `random_response` has it.
    """

    name: str
    time: float
    about: str
    coordinates: str
    states: tuple[str, ...]
    state_units: tuple[str, ...]
    inputs: tuple[str, ...]
    input_units: tuple[str, ...]
    outputs: tuple[str, ...]
    output_units: tuple[str, ...]
    A: Array
    B: Array
    C: Array
    D: Array
    M: Array
    damping: Array
    K: Array
    eigenvalues: Complex
    structural: NDArray[np.bool_]
    round_off: Array
    right: Complex
    left: Complex
    shift: Complex
    turn: Complex
    structural_zeros: tuple[str, ...]
    steady: bool
    remarks: tuple[str, ...]
    posed: Any = None
    no_modes: str = ""
    sampled: SampledModel | None = None
    random: Any = None
    trust: Trust = field(default_factory=lambda: Trust("green", "done"))

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader has to know: why no modes, on the states, and what checks have found that is more than that all is well."""
        found = [item for item in self.trust.items if item.name != "outcome"]
        said = [item.text for item in found if item.verdict != "green" or item.name != "steady"]
        first = (self.no_modes,) if self.no_modes else ()
        return (*first, *self.remarks, *said)

    @property
    def stable(self) -> bool:
        """Whether no eigenvalue is `growing`, with sampled controllers every pole has an absolute value of one at most; not where there are
        none to read."""
        if self.sampled is not None:
            return self.steady and self.sampled.stable
        return self.steady and not self.growing.any()

    @property
    def growing(self) -> NDArray[np.bool_]:
        """(n,) whether the real part of each eigenvalue is positive, by more than round-off; not of those that are exactly zero."""
        known = np.maximum(self.round_off, ROUND_OFF * np.abs(self.eigenvalues))
        return ~self.structural & (self.eigenvalues.real > known)

    @property
    def participation(self) -> Array:
        """(n, n) |w_ki x_ki| of state k in eigenvalue i, the sum over states made one."""
        return participation(self.left, self.right)

    @property
    def modes(self) -> tuple[Mode, ...]:
        """Eigenvalues in ascending order of magnitude, complex pairs once; none where the machine does not move steadily."""
        if not self.steady:
            return ()
        out, share = [], self.participation
        for k, value in enumerate(self.eigenvalues):
            if value.imag < 0.0:
                continue
            number, size = len(out) + 1, float(abs(value))
            ratio = float(0.0 - value.real / size) if size > 0.0 else float("nan")
            zero, taking = bool(self.structural[k]), taking_part(self.states, share[:, k])
            wrong, round_off = self._unresolved(number, complex(value)), float(self.round_off[k])
            out.append(Mode(number, complex(value), size / (2.0 * np.pi), ratio, zero, taking, wrong, round_off))
        return tuple(out)

    def _unresolved(self, number: int, value: complex) -> str:
        """What makes a mode wrong, as the trust report has it."""
        found, frequency = self.trust.found, abs(value) / (2.0 * np.pi)
        first = found.get("elements_of_vibrations", {}).get("first")
        if value.imag and first is not None and number >= first:
            return "not resolved by the elements of beams"
        bodies = [each["body"] for each in found.get("modes_of_vibrations", ()) if frequency > each["limit"]]
        return f"beyond the modes of {', '.join(bodies)}" if value.imag and bodies else ""

    def state_space(self) -> Any:
        """`scipy.signal.StateSpace` of A, B, C, D. Raises ModelError without inputs or outputs."""
        self._need_ports()
        return scipy.signal.StateSpace(self.A, self.B, self.C, self.D)

    def control(self) -> Any:
        """`control.StateSpace` with names, whose dots are underscores there: `rail_displacement`. Needs the package python-control."""
        control = needed("control", "a model of python-control needs")
        self._need_ports()
        names = {"states": self.states, "inputs": self.inputs, "outputs": self.outputs}
        plain = {kind: [name.replace(".", "_") for name in each] for kind, each in names.items()}
        return control.ss(self.A, self.B, self.C, self.D, **plain)

    def frequencies(self) -> Array:
        """[Hz] from a tenth of the slowest to ten times the fastest eigenvalue that is not zero."""
        size = np.abs(self.eigenvalues[~self.structural]) / (2.0 * np.pi)
        size = size[size > 0.0]
        low, high = (size.min(), size.max()) if len(size) else (0.1, 10.0)
        return np.geomspace(0.1 * low, 10.0 * high, FREQUENCIES)

    def frequency_response(self, frequencies: Sequence[float] | Array | None = None) -> xarray.DataArray:
        """G(iω) = C (iω - A)⁻¹ B + D, complex, (frequency [Hz], output, input).

        Raises ModelError without inputs or outputs, and where a frequency is that of an undamped vibration.
        """
        self._need_ports()
        f = np.atleast_1d(np.asarray(self.frequencies() if frequencies is None else frequencies, dtype=float))
        n = len(self.A)
        try:
            inner = np.array([np.linalg.solve(2j * np.pi * each * np.eye(n) - self.A, self.B) for each in f])
        except np.linalg.LinAlgError:
            infinite = "the response is infinite: a frequency is that of an undamped motion; leave it out"
            raise ModelError(infinite) from None
        values = self.C @ inner + self.D if n else np.broadcast_to(self.D, (len(f), *self.D.shape)).astype(complex)
        coordinates = {"frequency": f, "output": list(self.outputs), "input": list(self.inputs)}
        response = xarray.DataArray(values, coords=coordinates, dims=("frequency", "output", "input"), name="response")
        response.coords["frequency"].attrs["units"] = "Hz"
        return response

    def transmissibility(
        self, reference: str, input: str = "", frequencies: Sequence[float] | Array | None = None
    ) -> xarray.DataArray:
        """Responses of all outputs to `input` (the only one) over that of the output `reference`: complex, (frequency [Hz], output).

        Raises ModelError without inputs or outputs, for names that are none, and at the frequency of an undamped vibration.
        """
        return nivel.results.analyses.vibration.transmissibility(self, reference, input, frequencies)

    def random_response(
        self, psd: Mapping[str, Any] | str | PathLike[str], frequencies: Sequence[float] | Array | None = None
    ) -> xarray.Dataset:
        """Response to independent random inputs: `psd` (frequency [Hz], output), one-sided, and `rms` (output).

        psd : one-sided power spectral densities of inputs by name [unit²/Hz]: a level, which is white noise at all frequencies;
        (frequencies, levels), between which logarithms are straight; a table (CSV, MAT, Parquet) with a column `frequency`; or one table
        with a column for each input. Mean squares are integrals over the band to 1e-10, of white noise the solution of Lyapunov's equation,
        infinite where an output sees the input at once. Raises ModelError where inputs or units do not fit, and where the model is not
        stable or what is excited has no damping.
        """
        return nivel.results.analyses.vibration.random_response(self, psd, frequencies)

    def to_xarray(self) -> xarray.Dataset:
        """Everything, with names and units."""
        of_states, doubled = {"units": ", ".join(self.state_units)}, ("state", "state_")
        values = {
            "A": (doubled, self.A, of_states),
            "B": (("state", "input"), self.B, {"units of inputs": ", ".join(self.input_units)}),
            "C": (("output", "state_"), self.C, {"units of outputs": ", ".join(self.output_units)}),
            "D": (("output", "input"), self.D, {}),
            "M": (("coordinate", "coordinate_"), self.M, {}),
            "damping": (("coordinate", "coordinate_"), self.damping, {}),
            "K": (("coordinate", "coordinate_"), self.K, {}),
            "eigenvalue_real": (("eigenvalue",), self.eigenvalues.real, {"units": "1/s"}),
            "eigenvalue_imag": (("eigenvalue",), self.eigenvalues.imag, {"units": "1/s"}),
            "eigenvalue_round_off": (("eigenvalue",), self.round_off, {"units": "1/s"}),
            "structural": (("eigenvalue",), self.structural, {}),
            "participation": (("state", "eigenvalue"), self.participation, {}),
        }
        rates = (name.removesuffix(".rate") for name in self.states if name.endswith(".rate"))
        free = list(rates)[: len(self.M)]
        coordinates = {"state": list(self.states), "state_": list(self.states), "coordinate": free, "coordinate_": free}
        coordinates |= {"input": list(self.inputs), "output": list(self.outputs)}
        facts: dict[str, Any] = {"machine": self.name, "about": self.about, "time": self.time}
        facts["steady"] = int(self.steady)
        if (sampled := self.sampled) is not None:
            values |= {
                "transition": (("sampled_state", "sampled_state_"), sampled.transition, {}),
                "pole_real": (("pole",), sampled.poles.real, {"units": "1"}),
                "pole_imag": (("pole",), sampled.poles.imag, {"units": "1"}),
            }
            coordinates |= {"sampled_state": list(sampled.states), "sampled_state_": list(sampled.states)}
            facts["sampled"] = json.dumps(sampled.summary())
        if self.random is not None:
            values |= {
                f"random_{name}": (tuple(f"random_{dim}" for dim in each.dims), each.values, each.attrs)
                for name, each in self.random.data_vars.items()
            }
            coordinates |= {f"random_{dim}": self.random[dim].values for dim in self.random.dims}
        return xarray.Dataset(values, coords=coordinates, attrs=facts | self.trust.attributes())

    def _rows(self, select: list[str]) -> Rows:
        """The modes, one a row."""
        modes = self.modes
        columns = {
            "eigenvalue_real": Column([each.eigenvalue.real for each in modes], "1/s"),
            "eigenvalue_imag": Column([each.eigenvalue.imag for each in modes], "1/s"),
            "natural_frequency": Column([each.natural_frequency for each in modes], "Hz"),
            "damping_ratio": Column([each.damping_ratio for each in modes], "1"),
            "kind": Column([each.kind for each in modes], ""),
        }
        return Rows("mode", Column([each.number for each in modes], ""), chosen(columns, select))

    def animate(self, number: int = 1, *, height: int = 520) -> Inline:
        """Animation of mode `number` in a notebook. height : in pixels. Raises ModelError where there is no such mode."""
        return self.mode(number).animate(height=height)

    def mode(self, number: int) -> Result:
        """Mode `number` (from 1) as an animated motion: a period of a second, an amplitude that can be seen.

        Raises ModelError where there is no such mode.
        """
        return nivel.results.result.Result(nivel.results.analyses.mode_motion.linear_motion(self, number))

    def summary(self) -> dict[str, Any]:
        """Numbers and words for programs."""
        return {
            "machine": self.name,
            "about": self.about,
            "time": self.time,
            "coordinates": self.coordinates,
            "states": list(self.states),
            "inputs": list(self.inputs),
            "outputs": list(self.outputs),
            "steady": self.steady,
            "stable": self.stable if self.steady else None,
            "no_modes": self.no_modes,
            "headline": self.trust.headline,
            "trust": json.loads(self.trust.to_json()),
            "sampled": None if self.sampled is None else self.sampled.summary(),
            "rms": {} if self.random is None else dict(zip(self.outputs, self.random.rms.values.tolist(), strict=True)),
            "notes": list(self.notes),
            "structural_zeros": list(self.structural_zeros),
            "modes": [
                {
                    "eigenvalue": [each.eigenvalue.real, each.eigenvalue.imag],
                    "natural_frequency": each.natural_frequency,
                    "damping_ratio": None if np.isnan(each.damping_ratio) else each.damping_ratio,
                    "structural": each.structural,
                    "participation": dict(each.participation),
                    "unresolved": each.unresolved,
                }
                for each in (self.modes if self.steady else ())
            ],
        }

    def report(self, path: str | PathLike[str], *, force: bool = True) -> Path:
        """Write the page of the analysis: eigenvalues, modes, frequency response."""
        return write_page(provided("linear model")(self), path, force=force)

    def _need_ports(self) -> None:
        missing = [word for word, names in (("inputs", self.inputs), ("outputs", self.outputs)) if not names]
        if missing:
            raise ModelError(f"the model has no {' and no '.join(missing)}: name some when linearising")

    def __str__(self) -> str:
        head = f"{self.name}, linear about {self.about}: {len(self.states)} states; {self.trust.told}"
        if not self.steady:
            return "\n".join([head, *self.notes])
        lines = [f"  {each.number}: {mode_in_words(each)}" for each in self.modes[:LISTED]]
        lines += [f"  and {len(self.modes) - LISTED} more"] if len(self.modes) > LISTED else []
        lines += [f"  {each}" for each in self.sampled.words] if self.sampled is not None else []
        return "\n".join([head, *lines, *self.notes])


def mode_in_words(mode: Mode) -> str:
    """A mode in a line."""
    taking = ", ".join(name for name, _ in mode.participation)
    value = mode.eigenvalue
    if mode.structural:
        said = "0, exactly"
    elif value.imag:
        said = f"{mode.natural_frequency:.6g} Hz, {mode.kind}"
        said += f", damping ratio {mode.damping_ratio:.4g}" if mode.kind != "undamped vibration" else ""
        said += f" ({mode.number_in_words} 1/s)"
    else:
        said = f"{mode.number_in_words} 1/s, {mode.kind}"
    said += f", {mode.unresolved}" if mode.unresolved else ""
    return f"{said}; {taking}" if taking else said
