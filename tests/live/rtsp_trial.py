#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Tracks a recorded sequence that an RTSP server of this script plays at its own rate, and compares the poses with the
sequence's true ones. With --outage the server is gone for some seconds in the middle.

    /usr/bin/python3 tests/live/rtsp_trial.py --odosplat build/release/bin/odosplat --sequence SEQ --map map.ply --out DIR

SEQ is a folder in TUM layout with groundtruth.txt. Needs the Debian packages ffmpeg, python3-gi,
gir1.2-gst-rtsp-server-1.0, gstreamer1.0-plugins-base, -good and -bad."""
import argparse
import bisect
import json
import math
import os
import socket
import subprocess
import sys
import threading
import time


def rows(path):
    with open(path, encoding="utf-8") as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


def encode(sequence, video, fps):
    """H.264 with a key image per second, as cameras send it."""
    lines = "".join(
        f"file '{os.path.abspath(os.path.join(sequence, row[1]))}'\nduration {1.0 / fps}\n"
        for row in rows(os.path.join(sequence, "rgb.txt")))
    listed = video + ".txt"
    with open(listed, "w", encoding="utf-8") as file:
        file.write("ffconcat version 1.0\n" + lines)
    subprocess.run(["ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-f", "concat", "-safe", "0", "-r", str(fps),
                    "-i", listed, "-vf", f"setpts=N/{fps}/TB", "-r", str(fps), "-c:v", "libx264", "-crf", "15",
                    "-preset", "fast", "-tune", "zerolatency", "-g", str(fps), "-pix_fmt", "yuv420p", video], check=True)


class Server:
    """Plays the video to each client from its beginning."""

    def __init__(self, video, port):
        import gi
        gi.require_version("Gst", "1.0")
        gi.require_version("GstRtspServer", "1.0")
        from gi.repository import GLib, Gst, GstRtspServer
        Gst.init(None)
        self.loop = GLib.MainLoop()
        self.server = GstRtspServer.RTSPServer()
        self.server.set_service(str(port))
        factory = GstRtspServer.RTSPMediaFactory()
        factory.set_launch(f"( filesrc location={video} ! qtdemux ! h264parse ! rtph264pay name=pay0 pt=96 "
                           "config-interval=1 )")
        self.server.get_mount_points().add_factory("/cam", factory)
        self.server.attach(None)
        self.loop.run()


def start_server(video, port):
    server = subprocess.Popen([sys.executable, os.path.abspath(__file__), "--serve", video, "--port", str(port)])
    while server.poll() is None:
        try:
            socket.create_connection(("127.0.0.1", port), 1.0).close()
            return server
        except OSError:
            time.sleep(0.1)
    sys.exit("the RTSP server has ended")


def positions(path):
    return [(float(r[0]), [float(v) for v in r[1:4]]) for r in rows(path)]


def compare(estimate, truth):
    """Root mean square and largest distance [m] at the time offset for which they are least. Not aligned in space."""
    stamps = [t for t, _ in truth]

    def distances(offset, every):
        found = []
        for t, p in estimate[::every]:
            at = t + offset
            i = bisect.bisect_right(stamps, at)
            if i == 0 or i == len(stamps):
                continue
            (t0, a), (t1, b) = truth[i - 1], truth[i]
            share = (at - t0) / (t1 - t0)
            found.append(math.dist(p, [x + share * (y - x) for x, y in zip(a, b)]))
        return found

    def rms(offset, every):
        found = distances(offset, every)
        return math.sqrt(sum(d * d for d in found) / len(found)) if len(found) > 10 else math.inf

    best = stamps[0] - estimate[0][0]
    length = stamps[-1] - stamps[0]
    for step, span, every in ((0.05, length, 9), (0.005, 0.1, 3), (0.0005, 0.01, 1)):
        low = best if span == length else best - span
        best = min((low + k * step for k in range(int(2 * span / step))), key=lambda o: rms(o, every))
    found = distances(best, 1)
    return rms(best, 1), max(found), len(found)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--odosplat", default="build/release/bin/odosplat")
    parser.add_argument("--sequence")
    parser.add_argument("--map")
    parser.add_argument("--out")
    parser.add_argument("--fps", type=int, default=30)
    parser.add_argument("--port", type=int, default=38554)
    parser.add_argument("--seconds", type=float, default=0.0, help="interrupt after so long; 0: at the end")
    parser.add_argument("--outage", type=float, default=0.0, help="the server is gone for so long [s] at half time")
    parser.add_argument("--serve", help=argparse.SUPPRESS)
    words = parser.parse_args()
    if words.serve:
        Server(words.serve, words.port)
        return 0
    os.makedirs(words.out, exist_ok=True)
    video = os.path.join(os.path.abspath(words.out), "video.mp4")
    if not os.path.exists(video):
        encode(words.sequence, video, words.fps)
    server = start_server(video, words.port)
    length = len(rows(os.path.join(words.sequence, "rgb.txt"))) / words.fps
    run = os.path.join(words.out, "run")
    track = subprocess.Popen(
        [words.odosplat, "track", f"rtsp://me:secret@127.0.0.1:{words.port}/cam", "--map", words.map, "--camera",
         os.path.join(words.sequence, "camera.yaml"), "--out", run, "--reconnect", "0" if words.outage == 0.0 else "30",
         "--stream", "-"], stdout=subprocess.PIPE, text=True)
    lines = []
    first = threading.Event()

    def read():
        for line in track.stdout:
            lines.append(json.loads(line))
            first.set()

    reader = threading.Thread(target=read)
    reader.start()
    if words.outage > 0.0:
        first.wait(120.0)
        time.sleep(length / 2.0)
        server.kill()
        server.wait()
        time.sleep(words.outage)
        server = start_server(video, words.port)
        words.seconds = words.seconds or length / 2.0
    if words.seconds > 0.0:
        first.wait(120.0)
        # The server plays the video to every client, so that the source would never end.
        time.sleep(words.seconds)
        track.send_signal(2)
    status = track.wait()
    reader.join()
    server.kill()
    server.wait()
    with open(os.path.join(run, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    posed = [(line["time"], line["pose"][:3]) for line in lines if line["pose"] is not None]
    print(f"exit status {status}; lines {len(lines)}; "
          + "; ".join(f"{key} {json.dumps(report[key])}" for key in
                      ("frames", "posed", "lost", "dropped", "damaged", "reconnections", "latency_ms", "source")))
    assert "secret" not in json.dumps(report)
    if words.outage == 0.0 and len(posed) > 10:
        error, most, pairs = compare(posed, positions(os.path.join(words.sequence, "groundtruth.txt")))
        print(f"live poses against the true ones: {1000 * error:.1f} mm RMS, {1000 * most:.1f} mm most, {pairs} poses")
    return 0


if __name__ == "__main__":
    sys.exit(main())
