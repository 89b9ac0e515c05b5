"""Worst-case stack of a linked image: the call graph of its machine code, with the frame sizes that the compiler
wrote (-fcallgraph-info=su) where it compiled the function, and read off the code where a library did.

Refused rather than guessed: recursion, frames of unknown size, calls through a pointer."""
import collections
import pathlib
import re
import struct
import subprocess

TOOL = "arm-none-eabi-"
FUNCTION = re.compile(r"^([0-9a-f]+) <([^>]+)>:$")
BRANCH = re.compile(r"\t(bl|blx|b|b\.n|b\.w|b[a-z]{2}(?:\.[nw])?)\t[0-9a-f]+ <([^>+]+)>$")
INDIRECT = re.compile(r"\tblx\tr\d+|\tbx\tr(?!14)\d+")
NODE = re.compile(r'^node: \{ title: "(?:[^"]*:)?([^":]+)" label: ".*\\n(\d+) bytes \((static|dynamic[^)]*)\)')
# Call what comes before and after main(): constructors and destructors of static objects, not below main's path.
AROUND_MAIN = ("__libc_init_array", "__libc_fini_array")
REGISTERS = re.compile(r"\{([^}]*)\}")


class Function:
    def __init__(self):
        self.calls = set()
        self.frame = 0
        self.is_indirect = False


def disassemble(image):
    """{name: Function} of the machine code; a library's frame is the sum of what it pushes and subtracts."""
    functions, name = collections.defaultdict(Function), None
    for line in _lines(TOOL + "objdump", "-d", image):
        found = FUNCTION.match(line)
        if found:
            name = found.group(2)
        elif name:
            _take_instruction(functions[name], name, line)
    return functions


def _take_instruction(function, name, line):
    branch = BRANCH.search(line)
    if branch and not (branch.group(2) == name and not branch.group(1).startswith("bl")):
        function.calls.add(branch.group(2))
    function.is_indirect |= bool(INDIRECT.search(line))
    if re.search(r"\t(push|stmdb\tsp!|vpush)", line):
        function.frame += sum(_width(r) for r in REGISTERS.search(line).group(1).split(","))
    found = re.search(r"\tsub(?:w|\.w)?\tsp, (?:sp, )?#(\d+)|\tstr\S*\t.*\[sp, #-(\d+)\]!", line)
    function.frame += int(found.group(1) or found.group(2)) if found else 0


def _width(register):
    first, _, last = register.strip().partition("-")
    count = int(last[1:]) - int(first[1:]) + 1 if last else 1
    return count * (8 if first.startswith("d") else 4)


def compiled_frames(folders):
    """{name: bytes} of everything that was compiled here."""
    frames = {}
    for folder in folders:
        for path in pathlib.Path(folder).rglob("*.ci"):
            for line in path.read_text().splitlines():
                found = NODE.match(line)
                if not found:
                    continue
                if found.group(3) not in ("static", "dynamic,bounded"):
                    raise SystemExit(f"{found.group(1)}: its frame has no fixed size")
                frames[found.group(1)] = max(frames.get(found.group(1), 0), int(found.group(2)))
    return frames


def take_frames(functions, folders):
    """What the compiler wrote is surer than what the pushes add up to."""
    for name, size in compiled_frames(folders).items():
        if name in functions:
            functions[name].frame = size


def handlers(image, functions):
    """Names in the vector table, the stack pointer and the reset entry left out."""
    table = subprocess.run([TOOL + "objcopy", "-O", "binary", "-j", ".init", image, "/dev/stdout"],
                           stdout=subprocess.PIPE, check=True).stdout
    at = {}
    for line in _lines(TOOL + "nm", image):
        address, _, name = line.split()[-3:] if len(line.split()) == 3 else (None, None, None)
        if name in functions:
            at[int(address, 16) & ~1] = name
    words = struct.unpack(f"<{len(table) // 4}I", table[:len(table) // 4 * 4])
    return sorted({at[w & ~1] for w in words[2:] if w & ~1 in at})


def depth(functions, name, path=()):
    """(bytes, names from `name` to the deepest)."""
    if name in path:
        raise SystemExit("recursion: " + " -> ".join((*path[path.index(name):], name)))
    function = functions[name]
    if function.is_indirect and name not in AROUND_MAIN:
        raise SystemExit(f"{name} calls through a pointer")
    if not hasattr(function, "deepest"):
        deepest = max((depth(functions, call, (*path, name)) for call in sorted(function.calls)), default=(0, []))
        function.deepest = (function.frame + deepest[0], [name, *deepest[1]])
    return function.deepest


def worst_case(image, folders, interrupt_levels, bytes_per_level=104):
    """Bytes of the thread from the reset entry, of the interrupts on top, and the deepest path."""
    functions = disassemble(image)
    take_frames(functions, folders)
    thread, path = depth(functions, "_start")
    deepest_handler = max((depth(functions, handler)[0] for handler in handlers(image, functions)), default=0)
    return thread, interrupt_levels * (bytes_per_level + deepest_handler), path


def _lines(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines()
