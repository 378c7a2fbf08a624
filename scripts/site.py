#!/usr/bin/env python3
"""Builds the book as a site, with the pages that run, in target/site.

    python3 scripts/site.py            builds the site; installs mdBook from the registry if it is missing
    python3 scripts/site.py --pages    builds the pages alone
    python3 scripts/site.py --test     builds the pages and tests them in headless Chromium
    python3 scripts/site.py --record   the same, and stores the pictures that tests compare

A page is tested as a visitor sees it: it loads, draws the stored picture, shows a small change of H, makes frames,
and reacts to keys. The tests need the Python packages selenium and pillow, chromium and chromedriver.
"""

import functools
import http.server
import io
import shutil
import subprocess
import sys
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ROOT / "book" / "pages"
SITE = ROOT / "target" / "site"
TARGET = "wasm32-unknown-unknown"
# The largest size of a module, and for each page: the frames of the still picture, the largest change of H, and the
# slider that keys move.
MODULE = 300_000
NAMES = {
    "double_pendulum": (120, 1e-9, "mass"),
    "henon_heiles": (150, 1e-11, "energy"),
    "black_hole": (1, 1e-4, "spin"),
}
# The largest difference from the stored picture, as a share of that between it and a blank one.
DIFFERENCE = 0.25


def pages():
    """Compiles the modules and puts each beside its page."""
    subprocess.run(
        ["cargo", "build", "--release", "--locked", "--target", TARGET, "--target-dir", ROOT / "target",
         "--manifest-path", PAGES / "Cargo.toml"],
        check=True,
    )
    shutil.copytree(ROOT / "book" / "src" / "pages", SITE / "pages", dirs_exist_ok=True)
    for name in NAMES:
        module = SITE / "pages" / name / f"{name}.wasm"
        shutil.copy(ROOT / "target" / TARGET / "release" / f"{name}.wasm", module)
        size = module.stat().st_size
        print(f"{name}: {size} bytes")
        if size > MODULE:
            sys.exit(f"{name}.wasm has {size} bytes, more than {MODULE}")


def book():
    """Builds the book, by mdBook of the path or of target/tools."""
    mdbook = shutil.which("mdbook") or ROOT / "target" / "tools" / "bin" / "mdbook"
    if not Path(mdbook).exists():
        subprocess.run(["cargo", "install", "--locked", "mdbook", "--root", ROOT / "target" / "tools"], check=True)
    subprocess.run([mdbook, "build", ROOT / "book", "--dest-dir", SITE], check=True)


def difference(found, stored):
    """The mean difference of the colours of two pictures."""
    from PIL import Image, ImageChops, ImageStat

    stored = Image.open(stored).convert("RGB")
    found = found.convert("RGB").resize(stored.size)
    return sum(ImageStat.Stat(ImageChops.difference(found, stored)).mean) / 3


def test(record):
    """Opens each page in Chromium; a failure is an exit with the reason."""
    from PIL import Image
    from selenium import webdriver
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    handler = functools.partial(Quiet, directory=SITE / "pages")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for option in ["headless=new", "no-sandbox", "disable-gpu", "window-size=420,900", "disable-background-networking",
                   "disable-component-update", "disable-sync", "no-first-run", "force-device-scale-factor=1"]:
        options.add_argument(f"--{option}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.ChromeService(executable_path=shutil.which("chromedriver"))
    driver = webdriver.Chrome(options=options, service=service)
    faults = []
    try:
        for name, (still, bound, key) in NAMES.items():
            address = f"http://127.0.0.1:{server.server_port}/{name}/index.html"
            shown = lambda id: driver.find_element(By.ID, id).text
            count = "return window.page ? window.page.frames : 0"
            wait = WebDriverWait(driver, 60)

            driver.get(f"{address}?still={still}")
            wait.until(lambda driver: driver.execute_script(count) >= still)
            picture = Image.open(io.BytesIO(driver.find_element(By.ID, "canvas").screenshot_as_png))
            stored = PAGES / name / "picture.png"
            if record:
                picture.convert("RGB").resize((160, 160)).save(stored, optimize=True)
            blank = difference(Image.new("RGB", picture.size, "white"), stored)
            apart = difference(picture, stored) / blank
            drift = float(shown("drift"))
            if not apart <= DIFFERENCE:
                faults.append(f"{name}: the picture differs by {apart:.2f} of the difference of a blank one")
            if not 0.0 <= drift <= bound:
                faults.append(f"{name}: H changes by {drift}, more than {bound}")
            wide = driver.execute_script("return document.documentElement.scrollWidth - innerWidth")
            if wide > 0:
                faults.append(f"{name}: {wide} pixels wider than a phone")

            driver.get(address)
            wait.until(lambda driver: driver.execute_script(count) >= 1)
            rate = driver.execute_async_script("""
                const done = arguments[0], begin = window.page.frames, now = performance.now();
                setTimeout(() => done((window.page.frames - begin) / (performance.now() - now) * 1000), 2000);
            """)
            slider = driver.find_element(By.ID, key)
            before = slider.get_attribute("value")
            slider.send_keys(Keys.ARROW_RIGHT)
            if slider.get_attribute("value") == before:
                faults.append(f"{name}: keys do not move the slider {key}")
            if name == "henon_heiles":
                # Another energy clears the section; the next frame shows it.
                wait.until(lambda _: int(shown("orbits")) == 0)
                canvas = driver.find_element(By.ID, "canvas")
                canvas.send_keys(Keys.ARROW_RIGHT, Keys.ENTER)
                wait.until(lambda _: int(shown("orbits")) == 1)
            errors = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
            faults += [f"{name}: {error}" for error in errors if "favicon" not in error]
            print(f"{name}: picture within {apart:.0%}, change of H {drift:.1e}, {rate:.0f} frames a second")
    finally:
        driver.quit()
        server.shutdown()
    if faults:
        sys.exit("\n".join(faults))


def main():
    options = set(sys.argv[1:])
    if unknown := options - {"--pages", "--test", "--record"}:
        sys.exit(f"unknown: {' '.join(sorted(unknown))}\n{__doc__}")
    if not options:
        book()
    pages()
    if options & {"--test", "--record"}:
        test("--record" in options)


main()
