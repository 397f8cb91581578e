# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line (docs/command_line.md): files in, medial axes, lengths or skeletons as files out.

The same in three places: `blender --command medial_axis` from 4.2, `blender --background --python .../__main__.py --`
in every version, and `python3 -m medial_axis` without Blender.
"""

from __future__ import annotations

import _thread
import argparse
import math
import shlex
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from . import __version__
from .console import ClosedPipeError, Console, open_streams
from .core.batch.axis_work import AxisWork
from .core.batch.batch import Item, Work, begin, failure, finish
from .core.batch.frames import at_frame, has_number, output_path, parse_frames
from .core.batch.option_words import (
    add_options,
    add_sampling,
    add_thickness,
    sampling_from,
    settings_from,
)
from .core.batch.outputs import Files
from .core.batch.parts import items_of_parts
from .core.errors import (
    Cancelled,
    DegenerateInputError,
    InvalidInputError,
    MedialAxisError,
    ReadError,
)
from .core.files.extensions import extension_of
from .core.files.names import is_folder
from .core.files.read import READERS
from .core.files.read_shape import read_shape
from .core.files.write import FORMATS
from .core.machine import native
from .core.machine.job import Job, Outcome, Task
from .core.machine.memory_limit import MemoryLimit
from .core.settings import (
    BallSettings,
    Division,
    HollowSettings,
    MidSurfaceSettings,
    Settings,
    Side,
    SkeletonSettings,
    ThicknessSettings,
)
from .core.solid.measurement import UNKNOWN

DONE, FAILED, USAGE, INPUT, CANCELLED, THIN, UNMEASURED = range(7)
CLOSED_PIPE = 128 + 13  # the exit code by which shells report that SIGPIPE ended a program

_EXAMPLES = """\
INPUT     .off .obj .ply .stl .xyz .xyzn .npy .npz; inside Blender also .blend and what Blender imports.
          Without INPUT, inside Blender: the file that is open.
OUTPUT    a file (.ma .ply .obj .off .npz, or .csv for a table of the sheets), or a folder; {name} is
          the object or the file, {file} the file, #### the frame.

Other results: medial_axis thickness --help, medial_axis skeleton --help, medial_axis balls --help,
medial_axis midsurface --help, medial_axis hollow --help

examples:
  medial_axis bunny.ply bunny.ma
  medial_axis bunny.ply hand.obj axes/ --format ply --theta 30 --side both
  medial_axis cloth_####.obj axes/cloth_####.npz --frames 1-250
  medial_axis walk.blend axes/{name}_####.npz --frames 1-250 --object Body --json
  medial_axis hand.obj hand.ma --vertices 200
  medial_axis skeleton neuron.ply neuron.swc
  medial_axis balls robot.stl robot.json --count 64 --mode around
  medial_axis midsurface part.stl part.inp
  medial_axis hollow figure.stl shell.stl --wall 2

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used   4 cancelled
  141 nobody reads the results any more
"""


_EXAMPLES_OF_THICKNESS = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .csv   thickness at every vertex of the input and every other measured point
          .json  minimum, area and share below the limit, patches with place, area and minimum
          .ply   the measured surface, coloured: red at the limit, blue from three times the limit

examples:
  medial_axis thickness bracket.stl bracket.json --limit 1.2 --unit mm
  medial_axis thickness parts/*.stl reports/ --format csv --limit 1.2
  medial_axis thickness hinge.stl gaps.ply --limit 0.4 --gap

exit codes:
  0 nothing is thinner than the limit   1 something failed   2 wrong usage   3 an input cannot be used
  4 cancelled   5 something is thinner than the limit   6 something could not be measured
  141 nobody reads the results any more
"""

_EXAMPLES_OF_SKELETONS = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .swc   points with type, radius and parent; trees only, comments name edges that close loops
          .obj   a line for each branch
          .json  nodes with radii, edges, and the faces and measures of each branch
          .csv   a row for each branch: length, radii, curvature, torsion, cross-sections, ends
          .vtp   lines with the same measures, and those along each branch, for VTK and ParaView

examples:
  medial_axis skeleton neuron.ply neuron.swc --detail 0.7
  medial_axis skeleton vessel.stl vessel.csv
  medial_axis skeleton trees/*.obj lines/ --format obj
  medial_axis skeleton walk.blend lines/{name}_####.json --frames 1-250 --object Body

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used   4 cancelled
  141 nobody reads the results any more
"""


_EXAMPLES_OF_BALLS = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .ma    a vertex with its radius for each ball
          .json  centres, radii, the covered volume, how far balls reach out
          .urdf  a robot of one link with a collision sphere for each ball
          .mjcf .xml  a body of MuJoCo with a sphere for each ball

examples:
  medial_axis balls robot.stl robot.json --count 64 --mode around
  medial_axis balls robot.stl robot.urdf --count 100 --tolerance 1
  medial_axis balls parts/*.stl balls/ --format ma
  medial_axis balls walk.blend balls/{name}_####.json --frames 1-250 --object Body

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used   4 cancelled
  141 nobody reads the results any more
"""

_EXAMPLES_OF_MID_SURFACES = """\
INPUT     as of medial_axis --help.
OUTPUT    a file, or a folder; {name}, {file} and #### as there.
          .inp   shell elements S6, or S8R of quads, with their thickness, for CalculiX
          .obj   polygons, a group for each sheet
          .ply   triangles, with the thickness of each vertex and face
          .stl   triangles; a .csv beside it has the thickness of each
          With --keep-thick a file beside it ends with _thick.stl and has the faces of parts that are not thin.

examples:
  medial_axis midsurface part.stl part.inp --size 2
  medial_axis midsurface part.stl part.inp --size 2 --quads
  medial_axis midsurface parts/*.stl sheets/ --format obj

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used, or has no thin wall
  4 cancelled   141 nobody reads the results any more
"""

_EXAMPLES_OF_HOLLOW = """\
INPUT     as of medial_axis --help; the faces are closed.
OUTPUT    a file (.stl .ply .obj .off), or a folder; {name}, {file} and #### as there. It has the faces of
          the input, as triangles, and those of the cavity.

examples:
  medial_axis hollow figure.stl shell.stl --wall 2
  medial_axis hollow figures/*.stl shells/ --format stl --wall 2 --json

exit codes:
  0 all is there   1 something failed   2 wrong usage   3 an input cannot be used, or is nowhere so thick
  4 cancelled   141 nobody reads the results any more
"""


def main(words: Sequence[str]) -> int:
    """Run a command line; returns its exit code."""
    open_streams()
    try:
        wanted = _parse(words)
    except SystemExit as end:  # of argparse, which has said why
        return DONE if end.code in (None, 0) else USAGE
    console = Console(wanted.json, wanted.quiet, new_lines=inside_blender())
    if problem := native.problem():
        console.complain(problem)
        return FAILED
    with _interruptible():
        try:
            _check_outputs(wanted)
            code = _run(_items(wanted), wanted, console)
        except _UsageError as error:
            console.complain(str(error))
            return USAGE
        except KeyboardInterrupt:
            console.complain("cancelled")
            return CANCELLED
        except ClosedPipeError:
            return CLOSED_PIPE
    return FAILED if code in (DONE, THIN, UNMEASURED) and console.lost else code


def run() -> None:
    """Run the words behind `--` and end Blender with the exit code; for `--python-expr`."""
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    code = main(words)
    sys.stdout.flush()
    sys.exit(code)


def inside_blender() -> bool:
    return "bpy" in sys.modules


# --- reading the command line


def _parse(words: Sequence[str]) -> argparse.Namespace:
    named = _PARSERS.get(words[0]) if words else None
    parser = named() if named else _axis_parser()
    words = _with_paths_behind_dashes(words[1:] if named else words)
    wanted = parser.parse_intermixed_args(words)
    try:
        if more := shlex.split(wanted.options):
            wanted = parser.parse_intermixed_args([*words, *more])
        _complete(wanted)
    except (MedialAxisError, ValueError) as error:
        parser.error(str(error))
    return wanted


def _axis_parser() -> argparse.ArgumentParser:
    parser = _parser(
        "medial_axis", "The medial axis of meshes and point clouds, with radii.", _EXAMPLES
    )
    add_options(parser.add_argument_group("method"), Settings)
    parser.add_argument_group("small medial mesh").add_argument(
        "--vertices",
        type=int,
        default=0,
        metavar="N",
        help="reduce the axis to at most N vertices of the same topology (default: 0, all)",
    )
    files = _add_files(parser, [suffix[1:] for suffix in FORMATS], "ma")
    files.add_argument(
        "--triangles",
        action="store_true",
        help="write .ply, .obj and .off as triangles in text, which more programs read",
    )
    parser.set_defaults(known=(*FORMATS,), work_from=_axis_work)
    return parser


def _axis_work(wanted: argparse.Namespace) -> Work:
    settings = settings_from(wanted, Settings)
    _check_vertices(wanted.vertices, settings)
    return AxisWork(settings, wanted.triangles, wanted.vertices)


def _thickness_parser() -> argparse.ArgumentParser:
    from .core.files.write_thickness import THICKNESS_FORMATS

    parser = _parser(
        "medial_axis thickness",
        "How thick meshes and point clouds are, and where they are too thin.",
        _EXAMPLES_OF_THICKNESS,
    )
    lengths = parser.add_argument_group("lengths")
    add_thickness(lengths)
    lengths.add_argument(
        "--unit", default="", metavar="NAME", help="what lengths are in, for the report; mm, say"
    )
    add_sampling(parser.add_argument_group("method"))
    _add_files(parser, [suffix[1:] for suffix in THICKNESS_FORMATS], "json")
    parser.set_defaults(known=(*THICKNESS_FORMATS,), work_from=_thickness_work)
    return parser


def _thickness_work(wanted: argparse.Namespace) -> Work:
    from .core.batch.thickness_work import ThicknessWork

    return ThicknessWork(
        settings_from(wanted, Settings), settings_from(wanted, ThicknessSettings), wanted.unit
    )


def _skeleton_parser() -> argparse.ArgumentParser:
    from .core.files.write_skeleton import SKELETON_FORMATS

    parser = _parser(
        "medial_axis skeleton",
        "The curve skeletons of meshes and point clouds, with radii.",
        _EXAMPLES_OF_SKELETONS,
    )
    group = parser.add_argument_group("skeleton")
    add_options(group, SkeletonSettings)
    group.add_argument(
        "--end",
        action="append",
        default=[],
        type=_place,
        metavar="X,Y,Z",
        help="a place on the surface at the end of a limb; given two or more times, the skeleton keeps only what "
        "joins these ends (--end=-1,2,3 where a minus comes first)",
    )
    add_sampling(parser.add_argument_group("method"))
    _add_files(parser, [suffix[1:] for suffix in SKELETON_FORMATS], "json")
    parser.set_defaults(known=(*SKELETON_FORMATS,), work_from=_skeleton_work)
    return parser


def _skeleton_work(wanted: argparse.Namespace) -> Work:
    from .core.batch.skeleton_work import SkeletonWork

    return SkeletonWork(
        sampling_from(wanted), settings_from(wanted, SkeletonSettings), tuple(wanted.end)
    )


def _place(text: str) -> tuple[float, ...]:
    """Three finite numbers with commas between them."""
    try:
        numbers = tuple(float(word) for word in text.split(","))
        if len(numbers) == 3 and all(map(math.isfinite, numbers)):
            return numbers
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"Expected X,Y,Z, three finite numbers, found '{text}'")


def _balls_parser() -> argparse.ArgumentParser:
    from .core.files.write_balls import BALL_FORMATS

    parser = _parser(
        "medial_axis balls",
        "Solids as few balls of their medial axes, for collisions, physics and robots.",
        _EXAMPLES_OF_BALLS,
    )
    add_options(parser.add_argument_group("balls"), BallSettings)
    add_sampling(parser.add_argument_group("method"))
    _add_files(parser, [suffix[1:] for suffix in BALL_FORMATS], "json")
    parser.set_defaults(known=(*BALL_FORMATS,), work_from=_balls_work)
    return parser


def _balls_work(wanted: argparse.Namespace) -> Work:
    from .core.batch.balls_work import BallsWork

    return BallsWork(sampling_from(wanted), settings_from(wanted, BallSettings))


def _mid_surface_parser() -> argparse.ArgumentParser:
    from .core.files.write_mid_surface import MID_SURFACE_FORMATS

    parser = _parser(
        "medial_axis midsurface",
        "Thin solids as sheets with thickness, for shell elements and for modelling.",
        _EXAMPLES_OF_MID_SURFACES,
    )
    add_options(parser.add_argument_group("sheets"), MidSurfaceSettings)
    add_sampling(parser.add_argument_group("method"))
    _add_files(parser, [suffix[1:] for suffix in MID_SURFACE_FORMATS], "inp")
    parser.set_defaults(known=(*MID_SURFACE_FORMATS,), work_from=_mid_surface_work)
    return parser


def _mid_surface_work(wanted: argparse.Namespace) -> Work:
    from .core.batch.mid_surface_work import MidSurfaceWork

    return MidSurfaceWork(sampling_from(wanted), settings_from(wanted, MidSurfaceSettings))


def _hollow_parser() -> argparse.ArgumentParser:
    from .core.files.write_triangles import TRIANGLE_FORMATS

    parser = _parser(
        "medial_axis hollow",
        "Solids with a cavity, so that a wall of one thickness is left.",
        _EXAMPLES_OF_HOLLOW,
    )
    add_options(parser.add_argument_group("hollow"), HollowSettings)
    _add_files(parser, [suffix[1:] for suffix in TRIANGLE_FORMATS], "stl")
    parser.set_defaults(known=(*TRIANGLE_FORMATS,), work_from=_hollow_work)
    return parser


def _hollow_work(wanted: argparse.Namespace) -> Work:
    from .core.batch.hollow_work import HollowWork

    return HollowWork(settings_from(wanted, HollowSettings))


# The parsers by the first word of the command. Modules that only one of them needs are imported when it is used.
_PARSERS = {
    "thickness": _thickness_parser,
    "skeleton": _skeleton_parser,
    "balls": _balls_parser,
    "midsurface": _mid_surface_parser,
    "hollow": _hollow_parser,
}


def _parser(name: str, description: str, epilog: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=name,
        usage=f"{name} INPUT [INPUT ...] OUTPUT [options]",
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("paths", nargs="+", metavar="PATH", help="INPUT ... OUTPUT, see below")
    return parser


def _add_files(
    parser: argparse.ArgumentParser, formats: list[str], usual: str
) -> argparse._ArgumentGroup:
    """Adds the arguments that all kinds of work share; returns the group of the files, for more of them."""
    add_options(parser.add_argument_group("memory"), MemoryLimit)
    add_options(parser.add_argument_group("parts"), Division)
    files = parser.add_argument_group("files")
    files.add_argument("--frames", metavar="A-B", help="such as 1-250, 1-250:10 or 1,5,9-12")
    files.add_argument(
        "--object",
        action="append",
        metavar="NAME",
        help="of a file with objects, can be repeated (default: all visible meshes and point clouds)",
    )
    files.add_argument(
        "--format",
        choices=formats,
        default=usual,
        help=f"of files in a folder OUTPUT (default: {usual})",
    )
    files.add_argument(
        "--options", metavar="TEXT", default="", help="more options in one word, as farms pass them"
    )
    files.add_argument("--force", action="store_true", help="compute also what is finished")
    files.add_argument(
        "--allow-scripts",
        action="store_true",
        help="let .blend files of INPUT run the Python scripts and drivers in them",
    )
    files.add_argument("--json", action="store_true", help="one line of JSON per result")
    files.add_argument("--quiet", action="store_true", help="no progress and no warnings")
    parser.add_argument("--version", action="version", version=f"medial_axis {__version__}")
    return files


def _with_paths_behind_dashes(words: Sequence[str]) -> list[str]:
    """The words without `--`, behind which all are paths, also those that begin with a dash."""
    end = list(words).index("--") if "--" in words else len(words)
    return [*words[:end], *(f"./{word}" if word[:1] == "-" else word for word in words[end + 1 :])]


def _complete(wanted: argparse.Namespace) -> None:
    """Settings, inputs, the pattern of outputs and frames, or an error when they do not fit together."""
    *wanted.inputs, output = wanted.paths
    wanted.work, wanted.limit = wanted.work_from(wanted), settings_from(wanted, MemoryLimit)
    wanted.division = settings_from(wanted, Division)
    wanted.frames = None if wanted.frames is None else parse_frames(wanted.frames)
    if "" in wanted.paths:
        raise ValueError(
            "Expected names of files, found an empty one; look whether a variable is unset"
        )
    if output.endswith(("/", "\\")) or is_folder(output):
        number = "" if wanted.frames is None else "_####"
        output = str(Path(output, f"{{name}}{number}.{wanted.format}"))
    extension_of(output, wanted.known)
    wanted.output = output
    first = wanted.frames[0] if wanted.frames else None
    output_path(output, "name", "file", first)  # it raises what is wrong
    if not wanted.inputs and not inside_blender():
        raise ValueError("Expected INPUT and OUTPUT, found one path; add the other")
    if has_number(Path(output).name) != (wanted.frames is not None):
        raise ValueError(
            "Expected --frames together with #### in OUTPUT, found one without the other"
        )
    if wanted.frames is not None and (still := list(filter(_is_still, wanted.inputs))):
        raise ValueError(
            f"Expected #### in INPUT with --frames, found none in '{still[0]}'; add it"
        )
    if len(wanted.inputs) > 1 and not ("{name}" in output or "{file}" in output):
        raise ValueError(
            f"Expected a folder or {{name}} in OUTPUT for several inputs, found '{output}'; add it"
        )


def _check_vertices(vertices: int, settings: Settings) -> None:
    if vertices < 0:
        raise ValueError(f"Expected --vertices of 0 or more, found {vertices}; 0 keeps all")
    if vertices and settings.with_side().side is not Side.INNER:
        raise ValueError("Expected --side inner with --vertices, found another; leave out one")


def _is_still(path: str) -> bool:
    """Whether a path is one file for all frames: its format has none, and its name no number."""
    return Path(path).suffix.lower() in READERS and not has_number(Path(path).name)


# --- the items


class _UsageError(Exception):
    """Inputs and outputs do not fit together; nothing was computed."""


def _check_outputs(wanted: argparse.Namespace) -> None:
    """Check all outputs that are known before Blender loads a file: none is an input, and no two are the same."""
    items = [
        item for path in wanted.inputs if _is_file(path) for item in _items_of_file(path, wanted)
    ]
    inputs = [*wanted.inputs, *(item.input for item in items)]
    files = Files(inputs, getattr(wanted, "keep_thick", False))
    try:
        for item in items:
            files.claim(item.output)
    except InvalidInputError as error:
        raise _UsageError(str(error)) from error


def _is_file(path: str) -> bool:
    """Whether a path is read as a file, without Blender."""
    return Path(path).suffix.lower() in READERS or not inside_blender()


def _items(wanted: argparse.Namespace) -> Iterator[Item]:
    """The items one after the other, because Blender loads frames and files in between."""
    if not wanted.inputs:
        yield from _items_of_blender(None, wanted)
    for path in wanted.inputs:
        if _is_file(path):
            yield from _items_of_file(path, wanted)
        else:
            yield from _items_of_blender(path, wanted)


def _items_of_file(pattern: str, wanted: argparse.Namespace) -> Iterator[Item]:
    for frame in wanted.frames or (None,):
        path = pattern if frame is None else at_frame(pattern, frame)
        stem = Path(pattern).stem.rstrip("#").rstrip("_.-")
        yield _item(wanted.output, path, None, stem, frame, partial(read_shape, path, wanted.limit))


def _items_of_blender(path: str | None, wanted: argparse.Namespace) -> Iterator[Item]:
    """The objects of a file that Blender loads, frame by frame; None: of the file that is open."""
    from .bridge import read_scene

    source = path or read_scene.open_file() or "unsaved.blend"
    stem = Path(source).stem
    try:
        if path is not None:
            read_scene.load(path, wanted.allow_scripts)
        names = read_scene.names(list(filter(None, wanted.object or ())))
        if len(names) > 1 and "{name}" not in wanted.output:
            raise InvalidInputError(
                f"Expected {{name}} in OUTPUT for {len(names)} objects, found '{wanted.output}'; "
                "add it, or choose one with --object"
            )
    except Exception as error:  # Blender, or a script in the file, may raise anything
        yield Item(source, None, None, Path(wanted.output), partial(_raise, error))
        return
    for frame in wanted.frames or (None,):
        for name in names:
            read = partial(read_scene.read, name, frame)
            yield _item(wanted.output, source, name, stem, frame, read)


def _item(
    pattern: str,
    source: str,
    thing: str | None,
    file: str,
    frame: int | None,
    read: Callable[[], Any],
) -> Item:
    """One output; where it cannot have the name that the pattern gives, to read the item raises the reason."""
    try:
        name = file if thing is None else thing
        return Item(source, thing, frame, output_path(pattern, name, file, frame), read)
    except InvalidInputError as error:
        return Item(source, thing, frame, Path(pattern), partial(_raise, error))


def _raise(error: Exception) -> Any:
    raise error


# --- doing it


def _run(items: Iterable[Item], wanted: argparse.Namespace, console: Console) -> int:
    """All items; one that fails, however it does, does not stop the others."""
    code, thin, unknown = DONE, False, False
    files = Files(wanted.inputs, getattr(wanted, "keep_thick", False))
    for item in _divided(items, wanted):
        try:
            files.claim(item.output)
            report = _done(item, wanted, console)
            thin |= bool(report.get("patches"))
            unknown |= report.get("share_unmeasured", 0.0) > UNKNOWN
        except (KeyboardInterrupt, Cancelled):
            console.tell({**failure(item, Cancelled("cancelled")), "status": "cancelled"})
            return CANCELLED
        except Exception as error:
            report = failure(item, error)
            of_input = isinstance(error, (ReadError, InvalidInputError, DegenerateInputError))
            code = INPUT if of_input and code in (DONE, INPUT) else FAILED
        console.tell(report)
    if code != DONE:
        return code
    return THIN if thin else UNMEASURED if unknown else DONE


def _divided(items: Iterable[Item], wanted: argparse.Namespace) -> Iterator[Item]:
    """The items, or with --each-part those of the connected parts of each."""
    settings = sampling_from(wanted)
    for item in items:
        if not wanted.division.each_part:
            yield item
            continue
        try:
            found = items_of_parts(item, settings)
        except Exception as error:  # whatever reading raises
            found = [replace(item, read=partial(_raise, error))]
        yield from found


def _done(item: Item, wanted: argparse.Namespace, console: Console) -> dict[str, Any]:
    """The report of an item, which is computed unless it is finished."""
    begun = begin(item, wanted.work, wanted.force, wanted.limit)
    return begun.kept or finish(begun, _watch(begun.task, console.show))


def _watch(task: Task, show: Callable[[str], None]) -> Outcome:
    """Run a task in a thread, so that Ctrl-C stops it at once."""
    job = Job([task])
    try:
        while not job.wait(0.1):
            show(job.text)
        return job.outcomes()[0]
    except BaseException:
        job.stop()
        raise
    finally:
        show("")


@contextmanager
def _interruptible() -> Iterator[None]:
    """The first Ctrl-C or polite kill raises KeyboardInterrupt, inside Blender, too; more are ignored.

    Python drops what is raised while a weak reference dies, so there it is raised again a moment later.
    """
    hook, again = sys.unraisablehook, threading.Timer(0.05, _thread.interrupt_main)
    kept = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def stop(_number: int, _frame: object) -> None:
        for number in kept:
            signal.signal(number, signal.SIG_IGN)
        raise KeyboardInterrupt

    def dropped(what: sys.UnraisableHookArgs) -> None:
        if what.exc_type is not KeyboardInterrupt:
            return hook(what)
        signal.signal(signal.SIGINT, stop)
        again.start()

    for number in kept:
        signal.signal(number, stop)
    sys.unraisablehook = dropped
    try:
        yield
    finally:
        again.cancel()
        sys.unraisablehook = hook
        for number, handler in kept.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)
