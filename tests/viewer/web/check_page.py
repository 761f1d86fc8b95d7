#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Shows pages of `odosplat view web` in headless Chromium and Firefox.

check_page.py --odosplat BINARY --work FOLDER

Held against what must be: the rendering at poses of the path is that of `odosplat render` (PSNR above 35 dB), in either
order of blending and for every degree of colours that the map has; the page reports no fault and asks for nothing
outside; names with HTML in them are shown as they are; lost frames are told; nothing is wider than the window, from
390 pixels on, light and (in Chromium) dark; keys, pointer and address do what they say; without WebGL2 the page says so. Screenshots
are left in FOLDER. The data come from `odosplat demo`, made once. Prints the time per frame of the software renderer.
Exit 1 if anything is not as it must be, 77 (skipped) without a browser.
"""
import argparse
import base64
import os
import shutil
import subprocess
import sys

import browser

SKIPPED = 77
LEAST_PSNR_DB = 35.0
EVIL = "<b>&'x' {{map}}"  # no slash: it names files
LOST = range(30, 36)

COMPARE = """(async () => {
  const load = (url) => new Promise((done, fail) => {
    const image = new Image();
    image.onload = () => done(image);
    image.onerror = () => fail(new Error('image'));
    image.src = url;
  });
  const pixels = (image) => {
    const canvas = document.createElement('canvas');
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  const a = pixels(await load(await odosplat.stage.snapshot())), b = pixels(await load('REFERENCE'));
  if (a.length !== b.length) return -1;
  let sum = 0;
  for (let i = 0; i < a.length; ++i) sum += (a[i] - b[i]) ** 2;
  return 10 * Math.log10(255 * 255 / (sum / (0.75 * a.length)));
})()"""

MOVE = """(async () => {
  const stage = odosplat.stage, times = [];
  let last = performance.now();
  for (let i = 0; i < 12; ++i) {
    stage.free.turn(0.03, 0.0, false);
    stage.changed();
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    times.push(performance.now() - last);
    last = performance.now();
  }
  times.sort((a, b) => a - b);
  return [times[6].toFixed(0), stage.motionScale.toFixed(2)].join(' ms per frame, resolution ');
})()"""

failures = []


def expect(condition, words):
    if not condition:
        failures.append(words)
        print("FAILED: " + words)


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout


def make_data(odosplat, work):
    """demo/ (a room, its map, two runs), a run with lost frames and names with HTML, renderings at some poses."""
    demo = os.path.join(work, "demo")
    if not os.path.exists(os.path.join(demo, "table.txt")):
        run(odosplat, "demo", "--out", demo, "--frames", "120", "--iterations", "300", "--log", "warning")
    evil_run = os.path.join(work, EVIL)
    shutil.rmtree(evil_run, ignore_errors=True)
    shutil.copytree(os.path.join(demo, "gaussian"), evil_run)
    edit(os.path.join(evil_run, "status.csv"), lambda k, line: line.split(",")[0] + ",lost,0,0,1,0,0,,</script>" if k - 1 in LOST else line)
    edit(os.path.join(evil_run, "trajectory.txt"), lambda k, line: None if k - 1 in LOST else line)
    shutil.copy(os.path.join(demo, "map.ply"), os.path.join(work, EVIL + ".ply"))
    return demo, evil_run


def edit(path, change):
    with open(path, encoding="utf-8") as file:
        lines = [change(k, line) for k, line in enumerate(file.read().splitlines())]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(line for line in lines if line is not None) + "\n")


def other_order(source, target):
    """The same map with the other order of blending in its header."""
    with open(source, "rb") as file:
        data = file.read()
    words = (b"blend_order distance", b"blend_order depth   ")
    if words[0] not in data[:1 << 20]:
        raise SystemExit(f"{source}: its header has no blend_order distance")
    with open(target, "wb") as file:
        file.write(data.replace(words[0], words[1].rstrip(), 1))


def renderings(odosplat, work, demo, map_file, frames, name):
    """Data URLs of what `odosplat render` makes at the run's poses."""
    with open(os.path.join(demo, "gaussian", "trajectory.txt"), encoding="utf-8") as file:
        rows = [line for line in file.read().splitlines() if line and line[0] != "#"]
    poses = os.path.join(work, "poses.txt")
    with open(poses, "w", encoding="utf-8") as file:
        file.write("\n".join(rows[frame] for frame in frames) + "\n")
    out = os.path.join(work, "render_" + name)
    shutil.rmtree(out, ignore_errors=True)
    run(odosplat, "render", "--map", map_file, "--poses", poses, "--camera", os.path.join(demo, "sequence", "camera.yaml"),
        "--what", "color", "--out", out, "--log", "warning")
    urls = []
    for k in range(len(frames)):
        with open(os.path.join(out, "color", f"{k:06d}.png"), "rb") as file:
            urls.append("data:image/png;base64," + base64.b64encode(file.read()).decode())
    return urls


def show(window, page, state=""):
    window.open("about:blank")
    window.open("file://" + page.replace("<", "%3C").replace(">", "%3E") + "#" + state)
    window.wait_until("window.odosplat !== undefined && document.documentElement.dataset.settled === '1'")


def check_rendering(window, page, frames, references, words):
    for frame, reference in zip(frames, references):
        show(window, page, f"frame={frame}&mode=follow")
        psnr = window.evaluate(COMPARE.replace("REFERENCE", reference))
        print(f"{window.program}, {words}, frame {frame}: {psnr:.1f} dB")
        expect(psnr >= LEAST_PSNR_DB, f"{window.program}: {words}, frame {frame}: {psnr:.1f} dB")


def check_words(window, page):
    show(window, page, f"frame={LOST[1]}&mode=follow")
    expect(window.evaluate("document.title") == EVIL + ".ply", "the title is the map's name")
    expect(window.evaluate("document.querySelector('h1').textContent") == EVIL + ".ply", "the heading is the map's name")
    expect(window.evaluate("document.getElementById('path').options[0].textContent") == EVIL, "the run is called by its name")
    expect(window.evaluate("document.querySelectorAll('main b, header b').length") == 0, "a name makes no element")
    message = window.evaluate("document.getElementById('message').textContent")
    expect(message == f"Frame {LOST[1]}: lost: </script>", f"a lost frame is told: {message}")
    expect(window.evaluate("document.querySelectorAll('#plots figure').length") == 5, "three plots and two states")


def check_controls(window, page):
    show(window, page, "frame=3&mode=follow&color=sigma")
    press = "document.body.dispatchEvent(new KeyboardEvent('keydown', {key: '%s', bubbles: true}))"
    expect(window.evaluate("odosplat.state.color") == "sigma", "the address chooses the colours")
    window.evaluate(press % "ArrowRight")
    expect(window.evaluate("odosplat.state.frame") == 4, "the arrow goes to the next frame")
    window.evaluate(press % "End")
    expect(window.evaluate("odosplat.state.frame") == 119, "End goes to the last frame")
    window.evaluate(press % "2")
    expect(window.evaluate("odosplat.state.mode") == "orbit", "2 is orbit")
    before = window.evaluate("odosplat.stage.free.position.join()")
    window.evaluate("""(() => {
      const stage = document.getElementById('stage'), at = (kind, x, y) => stage.dispatchEvent(
          new PointerEvent(kind, {pointerId: 1, clientX: x, clientY: y, buttons: 1, bubbles: true}));
      stage.setPointerCapture = () => {};
      at('pointerdown', 300, 300);
      at('pointermove', 340, 310);
      at('pointerup', 340, 310);
    })()""")
    expect(window.evaluate("odosplat.stage.free.position.join()") != before, "a drag orbits")
    window.evaluate("new Promise((done) => setTimeout(done, 500))")
    expect("frame=119&mode=orbit" in window.evaluate("location.hash"), "the address follows")
    print(f"{window.program}, software renderer, 1280x800: {window.evaluate(MOVE)}")
    show(window, page, "frame=7&mode=follow&compare=side")
    expect(window.evaluate("odosplat.data.images.some((image) => image.frame === odosplat.state.frame)"),
           "compared frames have an image")


def check_layout(window, page, work):
    """No part is wider than the window, whatever is shown."""
    for width, height in ((1280, 800), (390, 844)):
        for dark in ((False, True) if window.has_dark else (False,)):
            window.resize(width, height, dark=dark, touch=width < 500)
            for state in ("mode=follow&frame=12", "mode=follow&frame=12&compare=side&paths=0",
                          "mode=follow&frame=12&compare=swipe", "mode=orbit&frame=60&color=state"):
                show(window, page, state)
                wide = window.evaluate("document.documentElement.scrollWidth - innerWidth")
                expect(wide <= 0, f"{window.program} {width}x{height} {state}: {wide} pixels too wide")
                name = f"{window.program}_{width}_{'dark' if dark else 'light'}_{state.replace('&', '_').replace('=', '-')}.png"
                with open(os.path.join(work, name), "wb") as file:
                    file.write(window.screenshot())
    window.resize(1280, 800)


def check_without_webgl(window, page):
    window.preload("HTMLCanvasElement.prototype.getContext = ((before) => function (kind, ...rest) {"
                   "return kind === 'webgl2' ? null : before.call(this, kind, ...rest); })"
                   "(HTMLCanvasElement.prototype.getContext)")
    show(window, page, "frame=3")
    expect("no WebGL2" in window.evaluate("document.getElementById('message').textContent"), "a page without WebGL2 says so")
    expect(window.evaluate("document.querySelectorAll('#plots figure').length") > 0, "and shows its plots")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--odosplat", required=True)
    parser.add_argument("--work", required=True)
    arguments = parser.parse_args()
    kinds = browser.available()
    if not kinds:
        print("skipped: neither chromium nor firefox-esr is installed")
        return SKIPPED
    work = os.path.abspath(arguments.work)
    os.makedirs(work, exist_ok=True)
    demo, evil_run = make_data(arguments.odosplat, work)
    frames = [5, 60, 110]
    maps = {EVIL: os.path.join(work, EVIL + ".ply"), "by depth": os.path.join(work, "depth.ply")}
    other_order(maps[EVIL], maps["by depth"])
    pages, references = {}, {}
    for name, map_file in maps.items():
        pages[name] = os.path.join(work, name.replace(" ", "_").replace("{", "").replace("&", "").replace("'", "") + ".html")
        print(run(arguments.odosplat, "view", "web", "--map", map_file, "--poses", evil_run,
                  os.path.join(demo, "interpolation"), "--truth", os.path.join(demo, "sequence"), "--sequence",
                  os.path.join(demo, "sequence"), "--images", "40", "--out", pages[name], "--log", "warning"), end="")
        references[name] = renderings(arguments.odosplat, work, demo, map_file, frames, name.replace(" ", "_"))
    for kind in (browser.Chromium, browser.Firefox):
        if kind not in kinds:
            print(f"skipped: {kind.program} is not installed")
            continue
        with kind() as window:
            window.resize(1280, 800)
            if not window.evaluate("Boolean(document.createElement('canvas').getContext('webgl2'))"):
                print(f"skipped: {kind.program} gives no WebGL2 here (Firefox needs Xvfb)")
                continue
            for name, page in pages.items():
                check_rendering(window, page, frames, references[name], name)
            check_words(window, pages[EVIL])
            check_controls(window, pages[EVIL])
            check_layout(window, pages[EVIL], work)
            check_without_webgl(window, pages[EVIL])
            expect(not window.faults, f"{kind.program} reports {[fault[:200] for fault in window.faults]}")
            outside = [url for url in window.requests if not url.startswith(("file:", "data:", "blob:", "about:"))]
            expect(not outside, f"{kind.program} asked for {outside}")
    print("failed" if failures else "all as it must be")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
