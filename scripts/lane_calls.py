#!/usr/bin/env python3
"""No call is left inside a lane loop, nothing that a step or its preparation needs calls vector instructions, and
no choice is stored under a mask, which takes some CPUs with AVX2 twenty times as long as a store.

Input: the assembly of a bench, made here by cargo. Output: for each level's entry, how many lane
loops it has; the exit status says whether one of them calls anything. A lane loop is an innermost
loop with packed arithmetic. The cold functions for rare arguments (`rare…`, `replace…`) are allowed:
they are reached by a branch that is not taken, and what else that branch calls before them is
allowed too. Those of a level (`rare…`) call nothing themselves.

    python3 scripts/lane_calls.py [BENCH …]        (by default: ensemble functions stages)

Symbols are read through `c++filt` (binutils), which knows the legacy mangling and v0.

A call in such a loop costs a factor of up to a hundred: what is not inlined is compiled without the
level's instructions and passes its packs through memory.
"""

import json
import os
import pathlib
import re
import subprocess
import sys

# The names below are paths, as `names` makes them of symbols.
# What is compiled with the instructions of a level; the function around it is a jump.
ENTRY = re.compile(r"level::dispatch::(\w+)::enter::inside$")
PACKED = re.compile(r"v?(add|sub|mul|div|sqrt|f(n?)m(add|sub)\d{3})pd$")
# Levels that every x86-64 has.
LEAST = {"portable", "sse2"}
# Rare arguments, and functions that enter the level themselves.
COLD = re.compile(r"::replace\w*$|::(?:rare|out_of_line)::entry$|dispatch::\w+::enter$")
# The functions of a level for rare arguments.
RARE = re.compile(r"Register>?::rare::entry$")
# What runs once for a chunk of members, or where one of them fails, and may call them.
SELDOM = re.compile(
    r"::replace|remove_failed|record_failures|for_each_with_sections|::cause$|::at_rest$|zeros_like$|::like$"
    r"|Linear.*::new$|PartialEq>?::ne$"
)
# An instruction of a level as a function.
INTRINSIC = re.compile(r"\s+call\w*\s+core::core_arch::.*::_mm\d")
# A symbol of Rust, in the legacy mangling or in v0, and how it is addressed.
SYMBOL = re.compile(r"\*?\b((?:_ZN|_R)[\w.$]+)(?:@\w+(?:\(%rip\))?)?")
# A label other than those within a function.
LABEL = re.compile(r"([^\s.].*?):(?:\s|$)")


def assemblies(benches):
    """The text that rustc emits for each bench, as one piece."""
    command = ["cargo", "build", "--release", "--message-format=json-render-diagnostics"]
    command += ["--config", 'profile.release.package."hamiltonian-dynamics".codegen-units=1']
    command += [word for bench in benches for word in ("--bench", bench)]
    # Cargo passes flags of rustc to one bench at a time, or to all crates; called by it, this program passes them to the
    # benches alone.
    wrapped = {"RUSTC_WRAPPER": __file__, "LANE_CALLS": " ".join(benches)}
    run = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True, env=os.environ | wrapped)
    found = {}
    for line in run.stdout.splitlines():
        message = json.loads(line)
        if message.get("executable"):
            found[message["target"]["name"]] = pathlib.Path(message["executable"]).with_suffix(".s")
    if absent := [bench for bench in benches if bench not in found or not found[bench].exists()]:
        sys.exit(f"cargo made no assembly of {', '.join(absent)}")
    return {bench: readable(found[bench].read_text()) for bench in benches}


def call_rustc(command):
    """Calls rustc, which also writes the assembly of the benches that are examined."""
    crate = dict(zip(command, command[1:])).get("--crate-name")
    emitted = ["--emit=asm"] if crate in os.environ["LANE_CALLS"].split() else []
    os.execvp(command[0], command + emitted)


def readable(text):
    """The assembly with the paths of its items in place of symbols; both manglings give the same paths."""
    symbols = sorted({symbol for symbol in SYMBOL.findall(text)})
    run = subprocess.run(["c++filt"], input="\n".join(symbols), stdout=subprocess.PIPE, text=True, check=True)
    paths = dict(zip(symbols, map(path_of, run.stdout.splitlines()), strict=True))
    return SYMBOL.sub(lambda found: paths[found[1]], text)


def path_of(name):
    """The path of a demangled item, without hashes and the arguments of functions, which v0 alone has."""
    name = re.sub(r"\.llvm\.\d+|::h[0-9a-f]{16}\b|(?<=\w)\[[0-9a-f]{8,}\]", "", name).replace("->", "→")
    name = re.sub(r"(?<=\w): (?:[iu](?:\d+|size)|bool|char)\b", "", name)
    name = re.sub(r"\{+closure(?:#\d+)?\}+", "{closure}", name)
    while (start := name.find("::<")) >= 0:
        depth, end = 1, start + 3
        while depth and end < len(name):
            depth += {"<": 1, ">": -1}.get(name[end], 0)
            end += 1
        name = name[:start] + name[end:]
    return name


def functions(text):
    """The entries of levels: (name of the level, instructions, index of each label)."""
    found, level = [], None
    for line in text.splitlines():
        if name := LABEL.match(line):
            entry = ENTRY.search(name[1])
            level = entry and entry[1]
            if level:
                code, labels = [], {}
                found.append((level, code, labels))
        elif level and (label := re.match(r"(\.\S+):", line)):
            labels[label[1]] = len(code)
        elif level and re.match(r"\s+[a-z]", line):
            operation, _, operands = line.strip().partition("\t")
            code.append((operation, operands))
    return found


def blocks(code, labels):
    """Basic blocks as (instructions, blocks that may follow), the entry first."""
    starts = {0, *(start for start in labels.values() if start < len(code))}
    starts |= {i + 1 for i, (o, _) in enumerate(code[:-1]) if re.match(r"j|ret|ud2", o)}
    order = sorted(starts)
    number = {start: b for b, start in enumerate(order)}
    found = []
    for b, start in enumerate(order):
        body = range(start, order[b + 1] if b + 1 < len(order) else len(code))
        operation, operands = code[body[-1]]
        after = []
        if operation.startswith("j") and operands in labels:
            after.append(number.get(labels[operands]))
        if not re.match(r"jmp|ret|ud2", operation) and b + 1 < len(order):
            after.append(b + 1)
        found.append((body, [a for a in after if a is not None]))
    return found


def loops(code, labels):
    """The innermost natural loops, each as its instructions."""
    graph = blocks(code, labels)
    before = [[] for _ in graph]
    for b, (_, after) in enumerate(graph):
        for a in after:
            before[a].append(b)
    # Which blocks every way to a block passes, as bits; blocks without a way to them keep all.
    everything = (1 << len(graph)) - 1
    passed = [1] + [everything] * (len(graph) - 1)
    changed = True
    while changed:
        changed = False
        for b in range(1, len(graph)):
            common = everything
            for a in before[b]:
                common &= passed[a]
            common |= 1 << b
            changed |= common != passed[b]
            passed[b] = common
    bodies = {}
    for latch, (_, after) in enumerate(graph):
        for header in after:
            if passed[latch] == everything or not passed[latch] >> header & 1:
                continue
            body, left = bodies.setdefault(header, {header}), [latch]
            while left:
                b = left.pop()
                if b not in body:
                    body.add(b)
                    left.extend(before[b])
    for header, body in bodies.items():
        if not any(other in body for other in bodies if other != header):
            inside = ([code[i] for i in graph[b][0]] for b in sorted(body))
            yield [line for block in inside if not is_cold(block) for line in block]


def is_cold(block):
    """True if the block calls a function for rare arguments."""
    return any(operation.startswith("call") and COLD.search(operands) for operation, operands in block)


def examine(text):
    """(level, lane loops, calls in them) of every entry of a level with instructions of its own.

    On the least level every function has the instructions, and loops of numbers are packed too.
    """
    for level, code, labels in functions(text):
        if level in LEAST:
            continue
        lane_loops, calls = 0, []
        for inside in loops(code, labels):
            if not any(PACKED.match(operation) for operation, _ in inside):
                continue
            lane_loops += 1
            calls += [
                operands
                for operation, operands in inside
                if operation.startswith("call")
            ]
        yield level, lane_loops, calls


def outside(text):
    """Functions that call vector instructions, but for those that seldom run: they are compiled without the
    instructions of the level."""
    found, name = set(), ""
    for line in text.splitlines():
        if label := LABEL.match(line):
            name = label[1]
        elif INTRINSIC.match(line) and not SELDOM.search(name) and not ENTRY.search(name):
            found.add(name)
    return sorted(found)


def calls_of_rare(text):
    """Functions for rare arguments that call something: a part of them lacks the instructions of the level."""
    found, name = set(), ""
    for line in text.splitlines():
        if label := LABEL.match(line):
            name = label[1]
        elif RARE.search(name) and re.match(r"\s+call", line) and "replace" not in line:
            found.add(name)
    return sorted(found)


def masked_stores(text):
    """Functions that store under a mask by AVX2: a choice was stored where it was read, without `Real::replaced`."""
    found, name = set(), ""
    for line in text.splitlines():
        if label := LABEL.match(line):
            name = label[1]
        elif re.match(r"\s+vmaskmovpd\t.*\)$", line):
            found.add(name)
    return sorted(found)


SAMPLE = """
{}:
\tvxorpd\t%ymm0, %ymm0, %ymm0
.LBB0_1:
\tvmulpd\t%ymm0, %ymm0, %ymm0
\tvucomisd\t%xmm1, %xmm0
\tja\t.LBB0_3
.LBB0_2:
\tdecq\t%rax
\tjne\t.LBB0_1
\tcallq\tafter_the_loop
\tretq
.LBB0_3:
\tcallq\t{}
\tjmp\t.LBB0_2
"""

# Symbols of each mangling: an entry, a function for rare arguments and one for a number, an instruction, a part of a
# scheme, the cause of a failure.
LEGACY = [
    "_ZN17hamiltonian_lanes5level8dispatch4avx25enter6inside17h13c655159116b312E",
    "_ZN94_$LT$core..core_arch..x86..__m256d$u20$as$u20$hamiltonian_lanes..level..register..Register$GT$4rare5entry"
    "17h0840bdaf592f9012E",
    "_ZN17hamiltonian_lanes5level4pack4wide16replace_in_packs17he46a06233b30ec16E.llvm.12",
    "_ZN4core9core_arch3x863avx13_mm256_mul_pd17h13c655159116b312E",
    "_ZN16hamiltonian_core19Collocated$LT$S$GT$4body28_$u7b$$u7b$closure$u7d$$u7d$17h13c655159116b312E",
    "_ZN16hamiltonian_core16Outcome$LT$T$GT$5cause17h13c655159116b312E",
]
V0 = [
    "_RINvNvNtNtNtCszHkGgZg4J3_17hamiltonian_lanes5level8dispatch4avx25enter6insideINtCse0GPiH9SR4V_9functions6Values"
    "NtB1g_2lnEEB1g_",
    "_RINvNvXNtNtCszHkGgZg4J3_17hamiltonian_lanes5level4avx2NtNtNtCsgEmfK2I1SDS_4core9core_arch3x867___m256dNtNtB7_"
    "8register8Register4rare5entryNtNtNtCs9FI4qQopIGn_16hamiltonian_real10elementary3arc12AngleOfPointINtNtNtB7_4pack"
    "8register1VBQ_EKj2_Kj1_KB3R_ECse0GPiH9SR4V_9functions",
    "_RINvNtNtNtCszHkGgZg4J3_17hamiltonian_lanes5level4pack4wide16replace_in_packsINtNtB4_8register1VNtNtB6_8portable"
    "3TwoEKj4_ECse0GPiH9SR4V_9functions",
    "_RNvNtNtNtCsgEmfK2I1SDS_4core9core_arch3x863avx13__mm256_mul_pd",
    "_RNCNvMCszHkGgZg4J3_16hamiltonian_coreINtB4_10CollocateddE4body0B4_",
    "_RNvMCszHkGgZg4J3_16hamiltonian_coreINtB2_7OutcomedKj6_E5cause",
]


def check_itself():
    """What is to be found is found, in both manglings, before its absence says anything."""
    for entry, rare, seldom, instruction, part, cause in [LEGACY, V0]:
        def loop(call):
            return list(examine(readable(SAMPLE.format(entry, call))))

        assert loop("sin") == [("avx2", 1, ["sin"])]
        assert loop(f"*{part}@GOTPCREL(%rip)")[0][2][0].endswith("::body::{closure}")
        for cold in [seldom, rare, f"*{rare}@GOTPCREL(%rip)", f"memset\n\tcallq\t{seldom}"]:
            assert loop(cold) == [("avx2", 1, [])]
        assert list(examine(readable(SAMPLE.format(part, "sin")))) == []

        def calls(search, caller, called):
            return len(search(readable(f"{caller}:\n\tcallq\t{called}\n")))

        assert calls(outside, part, instruction) == 1
        assert calls(outside, cause, instruction) == calls(outside, entry, instruction) == 0
        store, load = (f"{entry}:\n\tvmaskmovpd\t{o}\n" for o in ["%ymm0, %ymm1, 8(%rdi)", "8(%rdi), %ymm1, %ymm0"])
        assert len(masked_stores(readable(store))) == 1
        assert masked_stores(readable(load)) == []
        assert calls(calls_of_rare, rare, "add") == 1
        assert calls(calls_of_rare, rare, seldom) == calls(calls_of_rare, part, "add") == 0


def main():
    if "LANE_CALLS" in os.environ:
        call_rustc(sys.argv[1:])
    check_itself()
    failed = False
    for bench, text in assemblies(sys.argv[1:] or ["ensemble", "functions", "stages"]).items():
        total = 0
        for name in outside(text):
            failed = True
            print(f"FAILED {bench}: {name} calls vector instructions")
        for name in calls_of_rare(text):
            failed = True
            print(f"FAILED {bench}: {name} calls something")
        for name in masked_stores(text):
            failed = True
            print(f"FAILED {bench}: {name} stores under a mask, which `Real::replaced` avoids")
        for level, lane_loops, calls in examine(text):
            total += lane_loops
            failed |= bool(calls)
            verdict = f"FAILED, calls {', '.join(calls)}" if calls else "no call"
            print(f"{bench}, {level}: {lane_loops} lane loops, {verdict}")
        if total == 0:
            failed = True
            print(f"FAILED {bench}: no lane loop was found")
    sys.exit(failed)


if __name__ == "__main__":
    main()
