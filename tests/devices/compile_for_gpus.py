#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Compiles what a GPU would run for NVIDIA (sm_75) and AMD (gfx1030), without either, and looks at what comes out.

compile_for_gpus.py --exercise BINARY --work FOLDER [--kernel NAME]

exercise_kernels is run with a program cache of its own: the entries hold source and build options of every program as
the libraries build them, so there is no second list of variants here. Programs and kernels for CPUs are left out. One
line a kernel and variant is printed. Exit 1 if a kernel spills registers, uses private memory (scratch, .local), calls a
function, or takes more than 16 KiB of local memory; exit 77 (skipped) where clang-15 or libclc-15 is missing. Registers
and spills of NVIDIA are shown where ptxas is on the path.
"""
import argparse
import concurrent.futures
import os
import re
import shutil
import struct
import subprocess
import sys

SKIPPED = 77
CLANG = "clang-15"
LIBCLC = "/usr/lib/clc"
COMMON = ["-x", "cl", "-cl-std=CL1.2", "-Xclang", "-finclude-default-header", "-O3", "-nogpulib", "-w"]
TARGETS = {
    "amd gfx1030": (["-target", "amdgcn-amd-amdhsa", "-mcpu=gfx1030"], "amdgcn--amdhsa.bc"),
    "nvidia sm_75": (["-target", "nvptx64-nvidia-nvcl", "-Xclang", "-target-cpu", "-Xclang", "sm_75"],
                     "nvptx64--nvidiacl.bc"),
}
MAX_LOCAL_BYTES = 16 * 1024
# Variants for CPUs: tile shell, projection of eight Gaussians per work-item, sort of pairs in few long chunks.
FOR_CPUS = ["SHELL_TILE=1", "GW=8"]
KERNELS_FOR_CPUS = ["bin_histogram", "bin_totals", "bin_cursors", "bin_scatter"]


def programs(folder):
    """(name, options, text) of each entry of a program cache: header of 4 x 8 bytes, then the key, which is five lines
    (platform, device, driver, OpenCL version, options) and the source."""
    found = []
    for entry in sorted(os.listdir(folder)):
        with open(os.path.join(folder, entry), "rb") as file:
            content = file.read()
        magic, key_size = struct.unpack_from("<8sQ", content)
        if magic != b"osplat01":
            raise SystemExit(f"{entry}: not an entry of a program cache")
        *_, options, text = content[32:32 + key_size].decode().split("\n", 5)
        if any(option in options for option in FOR_CPUS):
            continue
        defines = " ".join(re.findall(r"-D (\S+)", options))
        files = "+".join(re.findall(r'#line 1 "(\w+)\.cl"', text))
        found.append((f"{files} {defines}".strip(), options.split(), text))
    return sorted(found)


def amd_figures(assembly):
    """Registers, spills, scratch and local memory of each kernel, from the metadata at the end and the comments."""
    figures = {}
    for block in re.split(r"\n  - \.args:", assembly)[1:]:
        value = {key: int(number) for key, number in re.findall(r"\n    \.(\w+): +(\d+)", block)}
        name = re.search(r"\n    \.name: +(\w+)", block).group(1)
        comments = assembly.split(f"\n{name}:", 1)[1]
        scratch = int(re.search(r"; ScratchSize: (\d+)", comments).group(1))
        occupancy = re.search(r"; Occupancy: (\d+)", comments).group(1)
        figures[name] = {
            "registers": f"{value['vgpr_count']} vector {value['sgpr_count']} scalar",
            "spills": value["vgpr_spill_count"] + value["sgpr_spill_count"],
            "private": max(scratch, value["private_segment_fixed_size"]),
            "local": value["group_segment_fixed_size"], "occupancy": occupancy}
    return figures


def nvidia_figures(assembly, path):
    figures = {}
    shared = {}
    for name, size in re.findall(r"\.shared \.align \d+ \.[bu]\d+ ([\w$]+)(?:\[(\d+)\])?;", assembly):
        kernel = name.split("_$_")[0].split(".")[0]
        shared[kernel] = shared.get(kernel, 0) + int(size or 4)
    for body in re.split(r"\n\.entry |\.visible \.entry ", assembly)[1:]:
        name = re.match(r"\s*(\w+)\(", body).group(1)
        private = sum(int(n) for n in re.findall(r"\.local \.align \d+ \.b8\s+\w+\[(\d+)\]", body))
        local = sum(size for kernel, size in shared.items() if kernel == name)
        figures[name] = {"registers": "unknown", "spills": 0, "private": private, "local": local, "occupancy": "-"}
        figures[name]["calls"] = len(re.findall(r"\bcall(?:\.uni)?\b", body))
    if shutil.which("ptxas"):
        done = subprocess.run(["ptxas", "-v", "-arch=sm_80", "-o", os.devnull, path], capture_output=True, text=True,
                              check=True)
        for name, stores, loads, registers in re.findall(
                r"Function properties for (\w+)\n.*?(\d+) bytes spill stores, (\d+) bytes spill loads\n.*?"
                r"Used (\d+) registers", done.stderr, re.S):
            figures[name]["registers"] = registers
            figures[name]["spills"] = int(stores) + int(loads)
    return figures


def compile_one(job):
    number, (name, options, text), target, work = job
    # A separate source file for each target: if one is rewritten, a compiler that is reading it may crash.
    stem = os.path.join(work, f"{number}-{target.split()[0]}")
    source, result = f"{stem}.cl", f"{stem}.s"
    with open(source, "w", encoding="utf-8") as file:
        file.write(text)
    flags, library = TARGETS[target]
    done = subprocess.run([CLANG, *COMMON, *flags, "-Xclang", "-mlink-bitcode-file", "-Xclang",
                           os.path.join(LIBCLC, library), *options, "-S", source, "-o", result],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return name, target, None, done.stderr
    with open(result, encoding="utf-8") as file:
        assembly = file.read()
    figures = amd_figures(assembly) if target.startswith("amd") else nvidia_figures(assembly, result)
    return name, target, figures, ""


def faults_of(figure):
    faults = []
    if figure["spills"]:
        faults.append("spills registers")
    if figure["private"]:
        faults.append(f"uses {figure['private']} bytes of private memory an item")
    if figure["local"] > MAX_LOCAL_BYTES:
        faults.append(f"takes more than {MAX_LOCAL_BYTES} bytes of local memory")
    if figure.get("calls"):
        faults.append("calls a function")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--exercise", required=True, help="exercise_kernels")
    parser.add_argument("--work", required=True, help="folder for sources and assembly")
    parser.add_argument("--kernel", default="", help="only kernels whose name holds this")
    options = parser.parse_args()
    missing = [what for what, there in [(CLANG, shutil.which(CLANG))] +
               [(os.path.join(LIBCLC, library), os.path.exists(os.path.join(LIBCLC, library)))
                for _, library in TARGETS.values()] if not there]
    if missing:
        print(f"skipped: no {', '.join(missing)} (packages clang-15 and libclc-15)")
        return SKIPPED
    cache = os.path.join(options.work, "programs")
    assembly = os.path.join(options.work, "assembly")
    for folder in (cache, assembly):
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
    subprocess.run([options.exercise, os.path.join(options.work, "exercise.txt")], check=True,
                   env=dict(os.environ, ODOSPLAT_CACHE_DIR=cache))
    found = programs(os.path.join(cache, "kernels"))  # folder as in lib/odosplat/compute/program_cache.hpp
    jobs = [(number, program, target, assembly) for number, program in enumerate(found) for target in TARGETS]
    failures = 0
    kernels = set()
    print(f"{'registers':>24} {'spills':>6} {'private':>7} {'local':>6} {'waves':>5}  kernel")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, target, figures, error in pool.map(compile_one, jobs):
            if figures is None:
                failures += 1
                print(f"{target}: {name} does not compile:\n{error}")
                continue
            for kernel, figure in figures.items():
                if options.kernel not in kernel or kernel in KERNELS_FOR_CPUS:
                    continue
                kernels.add(kernel)
                print(f"{figure['registers']:>24} {figure['spills']:>6} {figure['private']:>7} {figure['local']:>6} "
                      f"{figure['occupancy']:>5}  {target}: {kernel} ({name})")
                for fault in faults_of(figure):
                    failures += 1
                    print(f"FAILED: {target}: {kernel} ({name}) {fault}")
    print(f"{len(kernels)} kernels, {len(found)} programs, {len(TARGETS)} targets, {failures} faults")
    return 1 if failures or not kernels else 0


if __name__ == "__main__":
    sys.exit(main())
