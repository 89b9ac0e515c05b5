"""What a board's images weigh and how many instructions they take: the one source of these figures, for the tests
against budget.json and for the table in firmware/README.md. Everything is read from the build folder of the board's
preset."""
import json
import pathlib
import subprocess
import sys
import tempfile

import stack_depth

sys.path.append(str(pathlib.Path(__file__).parents[1] / "target"))
import process  # noqa: E402  (these lie in the folder of the emulator's scripts)
import synthetic_recording  # noqa: E402

BUDGET = pathlib.Path(__file__).with_name("budget.json")
# One for the line, the tick and whatever else has the same priority; one for the watchdog's interrupt or a fault.
INTERRUPT_LEVELS = 2
# More than one round of the work on the gap, in contact from a quarter of them on.
FRAMES = 24000
COUNT_LIMIT_S = 300
# Virtual time per instruction, 2^shift ns, as the count image of the board wants it.
EXACT = {"almec": "shift=0", "mps2-an386": "shift=10", "mps2-an500": "shift=10"}


class Build:
    """Where a board's build keeps what is looked at."""

    def __init__(self, board, folder):
        self.board, self.folder = board, pathlib.Path(folder)
        self.product = self.folder / "firmware/product"
        self.count = self.folder / "firmware/count"
        self.c_interface = self.folder / "tests/target/c_interface"
        self.monitor = self.folder / "tests/budget/CMakeFiles/monitor_size.dir/monitor_size.cpp.obj"

    def files(self):
        return [self.product, self.count, self.c_interface, self.monitor]


def budget():
    return json.loads(BUDGET.read_text())


def memory(build):
    """({name: bytes} of the product image, names on its deepest path)."""
    text, data, bss = _sections(build.product)
    objects = [build.folder / "firmware/CMakeFiles/product.dir", build.folder / "lib/CMakeFiles"]
    thread, interrupts, path = stack_depth.worst_case(build.product, objects, INTERRUPT_LEVELS)
    stack = thread + interrupts
    return {"flash_bytes": text + data,
            "ram_bytes": data + bss - _symbols(build.product)["__stack_size"][0] + stack,
            "stack_bytes": stack,
            "sizeof_monitor_bytes": _symbols(build.monitor)["morepro_monitor"][1]}, path


def c_stack(build, names):
    """{name: (bytes, deepest function)} of functions that programs call from where they like."""
    functions = stack_depth.disassemble(build.c_interface)
    stack_depth.take_frames(functions, [build.folder / "lib/c"])
    missing = [name for name in names if name not in functions]
    if missing:
        raise SystemExit(f"{build.c_interface}: no function {', '.join(missing)}")
    depths = {name: stack_depth.depth(functions, name) for name in names}
    return {name: (size, path[-1]) for name, (size, path) in depths.items()}


def instructions(build):
    """{name: (mean, most)} of the count image, exact."""
    with tempfile.TemporaryDirectory() as folder:
        frames = pathlib.Path(folder) / "frames.mrec"
        frames.write_bytes(synthetic_recording.recording(FRAMES))
        command = process.qemu(build.board, build.count, arguments=(frames,), extra=("-icount", EXACT[build.board]))
        status, text, _ = process.run(command, COUNT_LIMIT_S)
    if status != 0:
        raise SystemExit(f"{build.board}: the count image ended with status {status}: {text}")
    words = [line.split() for line in text.splitlines()]
    return {name: (int(mean), int(most)) for name, mean, most in words}


def _sections(image):
    text, data, bss = subprocess.run([stack_depth.TOOL + "size", image], stdout=subprocess.PIPE, check=True,
                                     text=True).stdout.splitlines()[1].split()[:3]
    return int(text), int(data), int(bss)


def _symbols(program):
    """{name: (value, size)}; what has no size has 0."""
    found = {}
    for line in subprocess.run([stack_depth.TOOL + "nm", "-S", program], stdout=subprocess.PIPE, check=True,
                               text=True).stdout.splitlines():
        *numbers, _, name = line.split()
        if numbers:
            found[name] = (int(numbers[0], 16), int(numbers[1], 16) if len(numbers) == 2 else 0)
    return found
