"""decode_recording.py BAG FOLDER: every ROS 2 message of a recording, through an npm reader.
decode_recording.py install FOLDER: only what is needed for it, and for foxglove.mjs, in FOLDER.

Takes the messages out of the .db3 file itself, has decode.mjs decode all maps, scans, transforms
and poses (npm packages go into FOLDER, by the committed lock file), and checks what they say
against each other. Says what it found; exit status 1 with one line where something is wrong.
"""

import base64
import collections
import json
import math
import pathlib
import shutil
import sqlite3
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TYPES = {
    "nav_msgs/msg/OccupancyGrid",
    "sensor_msgs/msg/LaserScan",
    "tf2_msgs/msg/TFMessage",
    "geometry_msgs/msg/PoseStamped",
    "std_msgs/msg/String",
}


def install(folder):
    """The packages of package-lock.json; again only where that changed."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("decode.mjs", "foxglove.mjs"):
        shutil.copy(HERE / name, folder / name)
    lock = (HERE / "package-lock.json").read_text()
    done = folder / "installed.lock"
    if done.exists() and done.read_text() == lock:
        return
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / name, folder / name)
    subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=folder, check=True)
    done.write_text(lock)


def read_bag(bag):
    (file,) = bag.glob("*.db3")
    rows = sqlite3.connect(f"file:{file}?mode=ro", uri=True).execute(
        "SELECT topics.name, topics.type, timestamp, data FROM messages JOIN topics "
        "ON topics.id = topic_id ORDER BY timestamp, messages.id"
    )
    return [row for row in rows if row[1] in TYPES]


def decode(rows, folder):
    lines = "".join(
        json.dumps({"topic": topic, "type": type_, "cdr": base64.b64encode(data).decode()}) + "\n"
        for topic, type_, _, data in rows
    )
    decoded = subprocess.run(
        ["node", "decode.mjs"], cwd=folder, input=lines, capture_output=True, text=True, check=False
    )
    assert decoded.returncode == 0, decoded.stderr.strip().splitlines()[:5]
    return [json.loads(line) for line in decoded.stdout.splitlines()]


def check_stamp(stamp, recorded_ns):
    stamp_ns = stamp["sec"] * 10**9 + stamp["nanosec"]
    assert abs(stamp_ns - recorded_ns) < 10**9, f"stamp {stamp} of a message recorded at {recorded_ns}"


def check_rotation(q):
    assert abs(q["x"]) + abs(q["y"]) < 1e-12 and abs(q["z"] ** 2 + q["w"] ** 2 - 1) < 1e-9, q


def check_map(message):
    info, data = message["info"], message["data"]
    assert message["header"]["frame_id"] == "map"
    assert abs(info["resolution"] - 0.05) < 1e-6
    assert len(data) == info["width"] * info["height"]
    assert set(data) == {-1, 0, 100}, set(data)
    check_rotation(info["origin"]["orientation"])


def check_scan(message, frames):
    assert message["header"]["frame_id"] in frames, message["header"]["frame_id"]
    count = len(message["ranges"])
    assert count > 10
    reach = message["angle_min"] + (count - 1) * message["angle_increment"]
    assert abs(message["angle_max"] - reach) < 1e-3
    ranges = [range_m for range_m in message["ranges"] if range_m != "NaN"]
    assert ranges and all(0 < range_m <= message["range_max"] for range_m in ranges)


def check(rows, decoded):
    assert len(decoded) == len(rows)
    frames, counts = set(), collections.Counter()
    for (topic, type_, recorded_ns, _), got in zip(rows, decoded):
        message = got["message"]
        counts[type_] += 1
        if type_ == "tf2_msgs/msg/TFMessage":
            for transform in message["transforms"]:
                frames.add(transform["child_frame_id"])
                check_stamp(transform["header"]["stamp"], recorded_ns)
                check_rotation(transform["transform"]["rotation"])
        elif type_ == "nav_msgs/msg/OccupancyGrid":
            check_map(message)
        elif type_ == "sensor_msgs/msg/LaserScan":
            check_scan(message, frames)
        elif type_ == "geometry_msgs/msg/PoseStamped":
            assert message["header"]["frame_id"] == topic.split("/")[1] + "/map"
            assert all(math.isfinite(value) for value in message["pose"]["position"].values())
            check_rotation(message["pose"]["orientation"])
        elif topic == "/lifeline/recording":
            json.loads(message["data"])
    missing = TYPES - set(counts)
    assert not missing, f"the recording has no {missing}"
    return counts


def main():
    bag, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    install(folder)
    if str(bag) == "install":
        return
    rows = read_bag(bag)
    counts = check(rows, decode(rows, folder))
    print("decoded:", ", ".join(f"{count} {type_}" for type_, count in sorted(counts.items())))


if __name__ == "__main__":
    try:
        main()
    except AssertionError as wrong:
        sys.exit(f"decode_recording: {wrong}")
