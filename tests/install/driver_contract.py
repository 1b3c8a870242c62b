#!/usr/bin/env python3
"""A driver outside the tree, and the contract suite on it, as docs/drivers.md says; then that driver, broken in several ways.

    driver_contract.py ROOT SECTION --folder FOLDER --prefix PREFIX --libdir LIBDIR --version VERSION
"""
import re
import subprocess
import sys

from follow_page import Page, follow_blocks, options_of, section

DRIVER = "MyCamera"
# What of the sample is replaced by what, and the one case that is to see it.  The last waits for most of a period,
# whatever timeout it is given.
FAULTS = (("  endLoans(sampleOf(self));\n", "", "EndsEveryLoanAtStop"),
          (" && slot.pixels == capture->image.data", "", "IgnoresTheReleaseOfAnothersCapture"),
          ("capture->sequence = frame;", "", "CountsTheCapturesOfAStreamUpwards"),
          ("  slot->token = ++sample->last_token;\n",
           "  std::this_thread::sleep_for(std::chrono::milliseconds(12));\n  slot->token = ++sample->last_token;\n",
           "DoesNotWaitForTheNextCapture"))
NEEDED = "#include <cstring>\n"  # what the faults include goes before it


def failed_cases(folder):
    """What the suite, compiled anew where the driver has changed, says of it."""
    subprocess.run(["cmake", "--build", "build"], cwd=folder, check=True, capture_output=True)
    said = subprocess.run([folder / "build" / "my_camera_contract"], text=True, capture_output=True, check=False).stdout
    return sorted(set(re.findall(rf"\[  FAILED  \] Drivers/DriverContract\.(\w+)/{DRIVER}", said)))


def main(options):
    print(follow_blocks(section(Page(options.root / "docs" / "drivers.md"), options.section), options.folder, options))
    driver, wrong = options.folder / "sample.cpp", []
    whole = driver.read_text(encoding="utf-8")
    for old, new, case in FAULTS:
        if whole.count(old) != 1:
            sys.exit(f"the sample has \"{old}\" {whole.count(old)} times")
        broken = whole.replace(old, new).replace(NEEDED, "#include <chrono>\n" + NEEDED + "#include <thread>\n")
        driver.write_text(broken, encoding="utf-8")
        failed = failed_cases(options.folder)
        if failed != [case]:
            wrong.append(f"without \"{old.strip()}\" these cases fail: {failed} instead of {case}")
    return wrong


if __name__ == "__main__":
    found = main(options_of(__doc__))
    print("\n".join(found))
    sys.exit(1 if found else 0)
