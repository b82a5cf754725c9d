"""Runs lifeline-demo as a user does: demo_test.py PROGRAMS_FOLDER DATA_FOLDER"""
import gzip
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAMS, DATA = (pathlib.Path(folder).resolve() for folder in sys.argv[1:3])
PATIENCE_S = 200  # for a demo; it takes about 50 s on two cores of its own
HELMET_FIELDS = {"agent_id", "scans", "scans_dropped", "common_map_sha256", "fingerprint", "trajectory_rmse_m",
                 "slam_ms_median", "slam_ms_p99", "bytes_sent"}
MERGE_FIELDS = {"a", "b", "accepted", "T_a_b", "error_m", "error_deg", "s_overlapping", "acceptance_index", "at_s"}


def processes_about(text):
    """Command lines of the running processes that speak of `text`."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if str(text) in command and int(folder.name) != os.getpid():
            found.append(command)
    return found


def gone_within(text, seconds):
    end = time.monotonic() + seconds
    while processes_about(text) and time.monotonic() < end:
        time.sleep(0.1)
    return not processes_about(text)


class Demo(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="lifeline-demo-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.report = self.folder / "report"

    def command(self, *options):
        return [PROGRAMS / "lifeline-demo", "--report", self.report, *options]

    def run_demo(self, *options):
        return subprocess.run(self.command(*options), capture_output=True, text=True, timeout=PATIENCE_S)

    def start_demo(self, *options):
        """A demo whose helmets have been heard."""
        demo = subprocess.Popen(self.command(*options), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(demo.stdout.close)
        self.addCleanup(demo.wait)
        self.addCleanup(demo.kill)
        for line in demo.stdout:
            if " scans " in line:
                return demo
        self.fail("the demo ended without a word of its helmets")

    def check_shared(self, done, helmets):
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        summary = json.loads((self.report / "summary.json").read_text())
        self.assertIs(summary["shared"], True)
        self.assertEqual([helmet["agent_id"] for helmet in summary["helmets"]], helmets)
        hashes = {helmet["common_map_sha256"] for helmet in summary["helmets"]}
        self.assertEqual(hashes, {summary["coordinator"]["common_map_sha256"]})
        self.assertRegex(hashes.pop(), "^[0-9a-f]{64}$")
        for name in ["common_map", *helmets]:
            picture = (self.report / f"{name}.png").read_bytes()
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n", name)
        return summary

    def check_failed(self, done, status, *words):
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(str(word), done.stderr)

    def test_three_helmets_come_to_share_one_map(self):
        done = self.run_demo()
        summary = self.check_shared(done, ["alpha", "bravo", "charlie"])
        self.assertLessEqual({"shared", "helmets", "coordinator", "merges", "wall_s"}, summary.keys())
        for helmet in summary["helmets"]:
            self.assertLessEqual(HELMET_FIELDS, helmet.keys())
            self.assertLessEqual(helmet["trajectory_rmse_m"], 0.10)
            self.assertGreater(helmet["scans"], 100)
        accepted = [merge for merge in summary["merges"] if merge["accepted"]]
        self.assertGreaterEqual(len({(merge["a"], merge["b"]) for merge in accepted}), 2)
        for merge in accepted:
            self.assertLessEqual(MERGE_FIELDS, merge.keys())
            self.assertLessEqual(merge["error_m"], 0.10)
            self.assertLessEqual(merge["error_deg"], 1.0)
        self.assertIs(summary["detections_agree"], True)
        self.assertEqual(sorted(find["kind"] for find in summary["detections"]), ["uwb_tag"] + 3 * ["victim"])
        for find in summary["detections"]:
            self.assertEqual(find["frame"], "common")
            self.assertLessEqual(find["error_m"], 0.5)
            self.assertIn(find["first_seen"]["by"], find["seen_by"])
        self.assertIn("all share one map", done.stdout)
        self.assertTrue(gone_within(self.report, 5), processes_about(self.report))

    def test_a_helmet_alone_maps_and_shares_nothing(self):
        done = self.run_demo("--helmets", "1")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("alpha was alone", done.stdout)
        summary = json.loads((self.report / "summary.json").read_text())
        self.assertIs(summary["shared"], False)
        self.assertEqual(summary["merges"], [])
        self.assertLessEqual(summary["helmets"][0]["trajectory_rmse_m"], 0.10)
        self.assertTrue((self.report / "alpha.png").exists())
        self.assertFalse((self.report / "common_map.png").exists())

    def check_log(self, name):
        log = DATA / "carmen" / name
        if not log.exists():
            self.skipTest(f"{log} is not there")
        summary = self.check_shared(self.run_demo("--log", log, "--helmets", "2"), ["alpha", "bravo"])
        accepted = [merge for merge in summary["merges"] if merge["accepted"]]
        self.assertLessEqual(accepted[-1]["error_m"], 0.30)
        self.assertLessEqual(accepted[-1]["error_deg"], 2.0)

    def test_two_halves_of_the_intel_log_come_to_share_one_map(self):
        self.check_log("intel-rawodom.log.gz")

    def test_two_halves_of_the_aces_log_come_to_share_one_map(self):
        self.check_log("aces-rawodom.log.gz")

    def test_interrupting_it_stops_everything(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(how):
                demo = self.start_demo()
                self.assertGreaterEqual(len(processes_about(self.report)), 5)
                demo.send_signal(how)
                demo.stdout.read()
                self.assertEqual(demo.wait(timeout=30), 1)
                self.assertEqual(processes_about(self.report), [])

    def test_killing_it_leaves_nothing_running(self):
        demo = self.start_demo()
        demo.kill()
        self.assertTrue(gone_within(self.report, 10), processes_about(self.report))

    def test_a_report_folder_that_cannot_be_written_is_told_before_anything_starts(self):
        self.report = self.folder / "file" / "report"
        (self.folder / "file").write_text("")
        done = self.run_demo()
        self.check_failed(done, 1, self.report, "--report")
        self.assertEqual(done.stdout, "")

    def test_missing_and_broken_logs_are_told_in_one_line(self):
        self.check_failed(self.run_demo("--log", self.folder / "no.log"), 1, "no.log")
        empty = self.folder / "empty.log"
        empty.write_text("ODOM 0 0 0 0 0 0 1 host 1\n")
        self.check_failed(self.run_demo("--log", empty), 1, "empty.log", "no scan")
        torn = self.folder / "torn.log.gz"
        torn.write_bytes(gzip.compress(os.urandom(10000))[:5000])
        self.check_failed(self.run_demo("--log", torn), 1, "torn.log.gz")

    def test_a_missing_plan_is_told_in_one_line(self):
        self.check_failed(self.run_demo("--plan", self.folder / "no.json"), 1, "no.json")

    def test_wrong_use_has_a_status_of_its_own(self):
        for wrong in (["--helmets", "0"], ["--helmets", "99"], ["--what"], ["--plan", "a", "--log", "b"]):
            self.assertEqual(self.run_demo(*wrong).returncode, 2, wrong)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
