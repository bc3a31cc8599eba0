"""Columns of binary tables: MATLAB's MAT files, Parquet files, and signals of recordings."""

import io
import json
import re
from collections.abc import Iterator
from pathlib import Path as FilePath
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.extras import needed, require
from nivel.files.apart import apart
from nivel.lazy import nivel, scipy
from nivel.words.wording import unknown_word

RECORDING_KINDS: Final = (".mf4", ".mcap")
TIME: Final = "time"
MOST_ELEMENTS: Final = 64  # of an array in a message
MOST_LISTED: Final = 40  # names in a message of a fault
NANO: Final = 1e-9

Signal = tuple[NDArray[np.float64], NDArray[np.float64], str]  # times [s], values, unit


def signal_columns(content: bytes, file: str, column: str | None) -> dict[str, tuple[NDArray[np.float64], str]]:
    """Times and values of the signal `column`, or of the only one. Raises ValueError, and ModelError where a library is missing."""
    if file.lower().endswith(".mf4"):  # what a damaged one leaves of its library ends with the process
        require("MDF files need", "asammdf")
        times, values, unit = apart(_mdf, content, column, failed="the file cannot be read")
    else:
        times, values, unit = _mcap(content, column)
    name = column or "value"
    return {TIME: (times, "s"), name: (values, unit)}


def _chosen(column: str | None, known: list[str]) -> str:
    """Raises ValueError."""
    if column in known:
        return str(column)
    if column is None and len(known) == 1:
        return known[0]
    listed = ", ".join(f"`{each}`" for each in known[:MOST_LISTED]) + (" …" if len(known) > MOST_LISTED else "")
    if column is None:
        raise ValueError(f"`column` is missing: it has the signals {listed or 'of no numbers'}")
    raise ValueError(unknown_word(column, known[:MOST_LISTED], "signal"))


def _mdf(content: bytes, column: str | None) -> Signal:
    """A channel, with the times of its group."""
    asammdf: Any = needed("asammdf", "MDF files need")
    with asammdf.MDF(io.BytesIO(content)) as file:
        masters = dict(file.masters_db.items())
        places = {
            name: found
            for name, entries in file.channels_db.items()
            if (found := [each for each in entries if masters.get(each[0]) != each[1]])
        }
        name = _chosen(column, list(places))
        if len(places[name]) > 1:
            raise ValueError(f"the signal `{name}` stands in {len(places[name])} groups; save it with one of them")
        signal = file.get(name, *places[name][0])
    values = np.asarray(signal.samples)
    if values.dtype.kind not in "fiub" or values.ndim != 1:
        raise ValueError(f"the signal `{name}` has no numbers")
    return np.asarray(signal.timestamps, dtype=np.float64), values.astype(np.float64), signal.unit or ""


def _mcap(content: bytes, column: str | None) -> Signal:
    """A number of the messages of a topic, `/joint_states.position[0]`; times are seconds from the first message of the file."""
    reader: Any = needed("mcap.reader", "MCAP files need")
    file = reader.make_reader(io.BytesIO(content), decoder_factories=_decoders())
    summary = file.get_summary()
    begin = summary.statistics.message_start_time if summary is not None and summary.statistics is not None else None
    channels = () if summary is None else summary.channels.values()
    named = [
        each.topic for each in channels if (column or "").startswith(f"{each.topic}.")
    ]  # else it has to be looked for
    times: dict[str, list[float]] = {}
    values: dict[str, list[float]] = {}
    for schema, channel, message in file.iter_messages(topics=[max(named, key=len)] if named else None):
        begin = message.log_time if begin is None else begin
        for path, value in _numbers(_decoded(schema, channel, message), channel.topic):
            times.setdefault(path, []).append((message.log_time - begin) * NANO)
            values.setdefault(path, []).append(value)
    name = _chosen(column, list(values))
    return np.array(times[name]), np.array(values[name]), ""


def _decoders() -> list[Any]:
    """Of messages of ROS 2, where its library is installed."""
    if not nivel.extras.is_installed("mcap_ros2.decoder"):
        return []
    decoder: Any = needed("mcap_ros2.decoder", "messages of ROS 2 need")
    return [decoder.DecoderFactory()]


def _decoded(schema: Any, channel: Any, message: Any) -> Any:
    """The content of a message. Raises ValueError."""
    if channel.message_encoding == "json":
        return json.loads(message.data)
    for factory in _decoders():
        if (decode := factory.decoder_for(channel.message_encoding, schema)) is not None:
            return decode(message.data)
    raise ValueError(
        f"messages of `{channel.topic}` have the encoding `{channel.message_encoding}`; json and ROS 2 are read"
    )


def _numbers(value: Any, path: str) -> Iterator[tuple[str, float]]:
    """All numbers in a message, by their paths."""
    if isinstance(value, bool | int | float | np.number):
        yield path, float(value)
    elif isinstance(value, dict):
        for name, each in value.items():
            yield from _numbers(each, f"{path}.{name}")
    elif isinstance(value, list | tuple | np.ndarray):
        for k, each in enumerate(value[:MOST_ELEMENTS]):
            yield from _numbers(each, f"{path}[{k}]")
    elif hasattr(type(value), "__slots__") and not isinstance(value, str | bytes):
        for name in type(value).__slots__:
            yield from _numbers(getattr(value, name), f"{path}.{name}")


KINDS: Final = (".mat", ".parquet", *RECORDING_KINDS)
MOST_ROWS: Final = 20_000_000  # of a table
UNNAMED: Final = re.compile(r"""["']?<_io\.BytesIO object at 0x[0-9a-f]+>["']?""")  # a file, in messages of libraries
UNIT_KEYS: Final = (b"unit", b"units")  # of the metadata of a field


class MeasuredError(Exception):
    """Why a file gives no table, in words."""


def measured_columns(
    content: bytes, file: str, column: str | None = None
) -> dict[str, tuple[NDArray[np.float64], str]]:
    """The columns of numbers of a file, with their units where it has any; of a recording the times and values of one signal.

    column : which one, where there are several. Raises MeasuredError.
    """
    suffix = FilePath(file).suffix.lower()
    try:
        if suffix in RECORDING_KINDS:
            found = _of_recording(content, file, column)
        else:
            found = _mat(content) if suffix == ".mat" else _parquet(content)
    except ModelError as error:
        raise MeasuredError(error.faults[0].message) from None
    except (ValueError, TypeError, KeyError, OSError, NotImplementedError, EOFError, IndexError, MemoryError) as error:
        raise MeasuredError(f"the file is damaged, or not what its name says: {' '.join(str(error).split())}") from None
    lengths = {len(values) for values, _ in found.values()}
    if len(found) < 2:
        raise MeasuredError("two columns of numbers or more were expected")
    if len(lengths) > 1:
        counts = ", ".join(f"`{name}` {len(values)}" for name, (values, _) in list(found.items())[:6])
        raise MeasuredError(f"its columns have different lengths: {counts}")
    if max(lengths) > MOST_ROWS:
        raise MeasuredError(f"{max(lengths)} rows; up to {MOST_ROWS} are read")
    return found


def _of_recording(content: bytes, file: str, column: str | None) -> dict[str, tuple[NDArray[np.float64], str]]:
    try:
        return signal_columns(content, file, column)
    except ModelError:
        raise
    except ValueError as problem:
        raise MeasuredError(str(problem)) from None
    except Exception as problem:  # libraries of recordings raise errors of their own
        raise MeasuredError(
            f"the file is damaged, or not what its name says: {' '.join(UNNAMED.sub('it', str(problem)).split())}"
        ) from None


def _mat(content: bytes) -> dict[str, tuple[NDArray[np.float64], str]]:
    """Vectors of real numbers; those that are called `time` or `t` come first."""
    found = {}
    for name, value in scipy.io.loadmat(io.BytesIO(content)).items():
        if (
            not name.startswith("__")
            and isinstance(value, np.ndarray)
            and value.dtype.kind in "fiu"
            and value.size == max(value.shape)
        ):
            found[name] = (value.astype(np.float64).ravel(), "")
    first = [name for name in found if name.lower() in ("time", "t")]
    return {name: found[name] for name in (*first, *(name for name in found if name not in first))}


def _parquet(content: bytes) -> dict[str, tuple[NDArray[np.float64], str]]:
    parquet: Any = needed("pyarrow.parquet", "Parquet files need")
    file = parquet.ParquetFile(io.BytesIO(content))
    if file.metadata.num_rows > MOST_ROWS:
        raise ValueError(f"{file.metadata.num_rows} rows; up to {MOST_ROWS} are read")
    table, found = file.read(), {}
    for field, column in zip(table.schema, table.columns, strict=True):
        values = column.to_numpy()
        if values.dtype.kind == "M":  # instants: seconds from the first one
            values = (values - values[0]).astype("timedelta64[ns]").astype(np.float64) * 1e-9
        if values.dtype.kind not in "fiu":
            continue
        unit = next((field.metadata[key].decode() for key in UNIT_KEYS if key in (field.metadata or {})), "")
        found[field.name] = (values.astype(np.float64), unit)
    return found
