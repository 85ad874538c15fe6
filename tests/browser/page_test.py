"""Pages of results in a browser: no error, no request, everything is drawn, and keys, slider and tables work.

usage: page_test.py STEREOBENCH SOURCE_DIR; exits with 77 (skipped) where there is no Chromium (Debian's package
chromium). Mutations that turn it red, each tried: the chart library left out (no chart is drawn); a picture's address
without "data:" (the browser asks, and the page's policy refuses); the arrow keys swapped; the slider's listener left
out, or its arrow keys leaf, too; a table's numbers sorted as texts; texts put in as HTML; an overlay that stays;
errors on the map as they are, whatever is chosen; dark colours on paper, or none on dark screens; charts that paper
does not get; no words, no commands.
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import chromium  # noqa: E402

STEREOBENCH, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SKIPPED = 77

# Part of a detector's command: it would be seen if texts became HTML, and end the script if it were not escaped.
EVIL = "# </script><img src=x onerror=alert(1)><!--"

# Our detector behind one that drops the balls of two colours.
DETECTOR = """
import json, subprocess, sys, threading
ours = subprocess.Popen(sys.argv[1:], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
def feed():
    while True:
        part = sys.stdin.buffer.read1(1 << 16)
        if not part: break
        ours.stdin.write(part); ours.stdin.flush()
    ours.stdin.close()
threading.Thread(target=feed, daemon=True).start()
for line in ours.stdout:
    answer = json.loads(line)
    if "balls" in answer:
        answer["balls"] = [ball for ball in answer["balls"] if ball.get("colour") not in (0, 8)]
    print(json.dumps(answer), flush=True)
"""

# How many colours each chart and map has, once it is on the screen: a blank canvas has one.
CHART_COLOURS = """
(async () => {
const frame = () => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
const coloursOf = (canvas) => {
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const colours = new Set();
  for (let i = 0; i < data.length; i += 4) colours.add(data[i] << 24 | data[i + 1] << 16 | data[i + 2] << 8 | data[i + 3]);
  return colours.size;
};
const counts = [];
for (const canvas of document.querySelectorAll('.chart canvas, .map canvas')) {
  canvas.scrollIntoView();
  for (let wait = 0; wait < 100 && coloursOf(canvas) < 2; ++wait) await frame();
  counts.push(coloursOf(canvas));
}
return counts;
})()
"""


def run(*arguments, expected=(0,)):
    done = subprocess.run([STEREOBENCH, *arguments], capture_output=True, text=True, cwd=FOLDER)
    if done.returncode not in expected:
        raise RuntimeError(f"{' '.join(arguments)}: {done.returncode}\n{done.stdout}{done.stderr}")


def make_pages():
    """A run, one of a worse detector, what changed between them, sweeps, a calibration, a log, and a study."""
    scenario = str(SOURCE / "assets/scenarios/ball_circle.yaml")
    short = [scenario, "--set", "path.laps=0.2", "--set", "gates=[]"]
    filters = ["--filters", "ekf,ufastslam", "--particles", "20"]
    (FOLDER / "worse.py").write_text(DETECTOR)
    worse = f"{sys.executable} {FOLDER}/worse.py {STEREOBENCH} detect --serve {EVIL}"
    run("run", *short, *filters, "--seeds", "0..2", "--gate", "vision.recall>=0.5", "--out", "before")
    run("run", *short, *filters, "--seeds", "0..2", "--out", "after", "--detector", worse)
    run("compare", "before", "after", "--html", "compare.html", expected=(0, 1))
    run("sweep", *short, *filters, "--seeds", "0..1", "--vary", "camera.noise_sd_levels=0,4", "--out", "sweep")
    field = [str(SOURCE / "assets/scenarios/open_field.yaml"), "--set", "path.step_s=4", "--set", "gates=[]"]
    field += ["--set", "filters=[ekf, smoother]"]
    run("sweep", *field, "--seeds", "0..4", "--vary", "oracle.bearing_sd_deg=0,0.5,2,8", "--out", "response")
    run("sensitivity", *field, "--samples", "16", "--vary", "oracle.range_sd_m=0.1..1", "--metric",
        "filters.ekf.ate_rms_m", "--out", "sensitivity")
    run("calibrate", scenario, "--seeds", "0..3", "--out", "calibration")
    run("render", scenario, "--set", "path.laps=0.2", "--out", "dataset")
    run("slam", "dataset", "--filters", "ekf", "--out", "log")


class Pages(unittest.TestCase):
    def open(self, name, **how):
        BROWSER.open((FOLDER / name).as_uri(), **how)

    def on_every_page(self, check):
        for name in ("before/report.html", "after/report.html", "compare.html", "sweep/report.html",
                     "response/report.html", "sensitivity/report.html", "calibration/report.html", "log/report.html"):
            with self.subTest(page=name):
                self.open(name)
                check(name)

    def test_nothing_is_asked_of_anybody_and_nothing_goes_wrong(self):
        def check(name):
            self.assertEqual(BROWSER.requests, [(FOLDER / name).as_uri()])
            self.assertEqual(BROWSER.complaints, [])
        self.on_every_page(check)

    def test_every_chart_and_map_is_drawn(self):
        def check(_):
            colours = BROWSER.value(CHART_COLOURS)
            self.assertGreater(len(colours), 0)
            self.assertGreater(min(colours), 10)
        self.on_every_page(check)

    def test_charts_far_below_are_drawn_for_paper(self):
        drawn = """[...document.querySelectorAll('.chart canvas')].map(canvas =>
          new Set(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data).size > 1)"""
        self.open("compare.html", height=200)
        self.assertIn(False, BROWSER.value(drawn))
        BROWSER.send("Emulation.setEmulatedMedia", media="print")
        BROWSER.settle()
        self.assertNotIn(False, BROWSER.value(drawn))

    def test_every_chart_and_map_has_words(self):
        def check(_):
            words = BROWSER.value("[...document.querySelectorAll('canvas')].map(c => c.getAttribute('aria-label'))")
            for text in words:
                self.assertRegex(text, r"^(Chart of .+ over .+\.|Map of \d+ instants)")
        self.on_every_page(check)

    def test_every_choice_of_charts_is_drawn(self):
        self.open("compare.html")
        menus = BROWSER.value("document.querySelectorAll('section select[aria-label=\"which chart\"]').length")
        self.assertGreater(menus, 1)
        BROWSER.value("""(async () => {
          for (const menu of document.querySelectorAll('section select'))
            for (let i = 0; i < menu.options.length; ++i) {
              menu.selectedIndex = i;
              menu.dispatchEvent(new Event('change'));
            }
        })()""")
        self.assertEqual(BROWSER.complaints, [])
        for count in BROWSER.value(CHART_COLOURS):
            self.assertGreater(count, 10)

    def test_a_response_has_no_level_0_and_one_colour_a_filter(self):
        """A logarithmic axis has no place for 0. Red where points at 0 are kept, and where a law is a name of its own."""
        self.open("response/report.html")
        BROWSER.value(CHART_COLOURS)
        charts = BROWSER.value("""[...document.querySelectorAll('.chart canvas')].map(c => Chart.getChart(c)).map(chart => ({
          log: chart.options.scales.x.type === 'logarithmic',
          series: chart.data.datasets.map(({label, data, borderColor}) => ({label, data, borderColor}))}))""")
        curves = [chart for chart in charts if chart["log"]]
        self.assertEqual(len(curves), 1)
        series = {one["label"]: one for one in curves[0]["series"]}
        self.assertEqual([point["x"] for point in series["ekf"]["data"]], [0, 0.5, 2, 8])
        self.assertEqual([point["y"] is None for point in series["ekf"]["data"]], [True, False, False, False])
        laws = [label for label in series if label.endswith(", law")]
        self.assertGreater(len(laws), 0)
        for law in laws:
            self.assertEqual(series[law]["borderColor"], series[law.removesuffix(", law")]["borderColor"])

    def test_texts_are_no_html(self):
        self.open("after/report.html")
        facts = BROWSER.value("[...document.querySelectorAll('.facts li')].map(fact => fact.textContent)")
        self.assertTrue(any(fact.startswith("detector: ") and fact.endswith(EVIL) for fact in facts), facts)
        self.assertEqual(BROWSER.value("document.querySelectorAll('.facts li *').length"), 0)

    def test_arrow_keys_leaf_through_the_pairs(self):
        self.open("before/report.html")
        title = "document.querySelector('.frames strong').textContent"
        source = "document.querySelector('.frames img').src"
        self.assertRegex(BROWSER.value(title), r"^1 of \d+: seed \d+, frame \d+$")
        first = BROWSER.value(source)
        BROWSER.press("ArrowRight", 39)
        self.assertRegex(BROWSER.value(title), "^2 of ")
        self.assertNotEqual(BROWSER.value(source), first)
        BROWSER.press("ArrowLeft", 37)
        BROWSER.press("ArrowLeft", 37)  # the first one stays
        self.assertRegex(BROWSER.value(title), "^1 of ")
        self.assertEqual(BROWSER.value(source), first)

    def test_pictures_are_shown_and_overlays_switch(self):
        self.open("after/report.html")
        size = BROWSER.value("""(async () => {
          const image = document.querySelector('.frames img');
          await image.decode();
          return [image.naturalWidth, image.naturalHeight];
        })()""")
        self.assertEqual(size, [1024, 768])
        self.assertGreater(BROWSER.value("document.querySelectorAll('.frames .truth .missed').length"), 0)
        shown = "getComputedStyle(document.querySelector('.frames .view .{}')).display"
        for place, name in enumerate(("truth", "seen"), start=1):
            self.assertNotEqual(BROWSER.value(shown.format(name)), "none")
            BROWSER.click(f".frames .tools label:nth-of-type({place}) input")
            self.assertEqual(BROWSER.value(shown.format(name)), "none")
            BROWSER.click(f".frames .tools label:nth-of-type({place}) input")
            self.assertNotEqual(BROWSER.value(shown.format(name)), "none")

    def test_the_slider_moves_the_map(self):
        self.open("before/report.html")
        pixels = "document.querySelector('.map canvas').toDataURL()"
        last = BROWSER.value(pixels)
        BROWSER.value("document.querySelector('.map input[type=range]').focus()")
        BROWSER.press("Home", 36)
        first = BROWSER.value(pixels)
        self.assertNotEqual(first, last)
        self.assertRegex(BROWSER.value("document.querySelector('.map output').textContent"), "^0 s, 0 of ")
        BROWSER.press("ArrowRight", 39)
        self.assertNotEqual(BROWSER.value(pixels), first)
        self.assertRegex(BROWSER.value("document.querySelector('.frames strong').textContent"), "^1 of ")

    def test_larger_errors_are_drawn_larger(self):
        self.open("before/report.html")
        pixels = "document.querySelector('.map canvas').toDataURL()"
        # The batch alone, which has no ellipses: its path must move.
        BROWSER.value("""(() => {
          for (let i = 0; i < document.querySelectorAll('.map .legend input').length - 1; ++i)
            document.querySelectorAll('.map .legend input')[i].click();
        })()""")
        before = BROWSER.value(pixels)
        BROWSER.value("""(() => {
          const menu = document.querySelector('.map select');
          menu.selectedIndex = 4;
          menu.dispatchEvent(new Event('change'));
        })()""")
        self.assertNotEqual(BROWSER.value(pixels), before)

    def test_tables_sort_by_mouse_and_by_key(self):
        self.open("before/report.html")
        table = "[...document.querySelectorAll('table')].find(t => t.textContent.includes('ATE rms'))"
        cells = f"[...({table}).querySelectorAll('tbody tr')].map(row => row.cells[2].textContent)"
        number = f"({cells}).filter(text => text !== '-').map(text => parseFloat(text))"
        BROWSER.value(f"({table}).querySelectorAll('th button')[2].id = 'errors'")
        unsorted = BROWSER.value(number)
        BROWSER.click("#errors")
        self.assertEqual(BROWSER.value(number), sorted(unsorted))
        self.assertEqual(BROWSER.value("document.querySelector('#errors').parentElement.ariaSort"), "ascending")
        BROWSER.value("document.querySelector('#errors').focus()")
        BROWSER.press(" ", 32)
        self.assertEqual(BROWSER.value(number), sorted(unsorted, reverse=True))

    def test_what_passes_is_shown_on_demand(self):
        self.open("compare.html")
        rows = "[...document.querySelectorAll('tbody tr')].filter(row => row.offsetHeight > 0).length"
        before = BROWSER.value(rows)
        BROWSER.value("[...document.querySelectorAll('button')].find(b => b.textContent.startsWith('Show')).click()")
        self.assertGreater(BROWSER.value(rows), before)

    def test_nothing_is_wider_than_the_smallest_screen(self):
        for name in ("before/report.html", "compare.html", "sweep/report.html", "calibration/report.html"):
            for dark in (False, True):
                self.open(name, width=360, height=780, dark=dark)
                self.assertLessEqual(BROWSER.value("document.documentElement.scrollWidth"), 360)

    def test_dark_screens_get_a_dark_page(self):
        def brightness(dark, media=""):
            self.open("before/report.html", dark=dark, media=media)
            colour = BROWSER.value("getComputedStyle(document.body).backgroundColor")
            return sum(int(part) for part in colour[4:-1].split(",")[:3])
        self.assertGreater(brightness(False), 600)
        self.assertLess(brightness(True), 150)
        self.assertGreater(brightness(True, "print"), 600)  # paper is white

    def test_the_first_thing_is_the_verdict(self):
        for name, title in (("compare.html", "Verdicts"), ("before/report.html", "Gates")):
            self.open(name)
            self.assertEqual(BROWSER.value("document.querySelector('h2').textContent"), title)

    def test_each_part_has_its_command(self):
        self.open("before/report.html")
        lines = BROWSER.value("[...document.querySelectorAll('.command code')].map(code => code.textContent)")
        parts = BROWSER.value("document.querySelectorAll('section').length")
        self.assertEqual(len(lines), parts)
        for line in lines:
            self.assertRegex(line, r"^stereobench (run|render) .*ball_circle\.yaml .*--seeds \S+")


if __name__ == "__main__":
    if chromium.PROGRAM is None:
        print("skipped: there is no Chromium (Debian's package chromium)")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="stereobench_pages_") as name:
        FOLDER = pathlib.Path(name)
        make_pages()
        BROWSER = chromium.Chromium()
        try:
            outcome = unittest.main(argv=sys.argv[:1] + sys.argv[3:], exit=False, verbosity=2).result
        finally:
            BROWSER.close()
    sys.exit(0 if outcome.wasSuccessful() else 1)
