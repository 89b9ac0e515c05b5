"""Adds up what CTest wrote for every preset: shows what failed and was skipped, then one line for all.

Usage: summary.py FOLDER with one PRESET.xml per preset. Exits 1 where a test failed or none ran.
"""

import pathlib
import sys
import xml.etree.ElementTree as xml


def main(folder):
    total = {"run": 0, "fail": 0, "notrun": 0}
    for path in sorted(pathlib.Path(folder).glob("*.xml")):
        for case in xml.parse(path).getroot().iter("testcase"):
            status = case.get("status") if case.get("status") in total else "notrun"
            total[status] += 1
            if status == "fail":
                output = case.findtext("system-out") or ""
                print(f"FAILED {path.stem}: {case.get('name')}\n{output[-6000:]}")
            elif status == "notrun":
                output = (case.findtext("system-out") or "").strip().splitlines()
                print(f"skipped {path.stem}: {case.get('name')}: {output[-1] if output else 'no reason given'}")
    print(f"{total['run']} passed, {total['fail']} failed, {total['notrun']} skipped")
    return 1 if total["fail"] > 0 or total["run"] == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
