// The pages in a real browser: judged by axe-core, as wide as a phone, printed. Nothing of this is
// needed to build or to use frictab: tests skip where Chromium (Debian's chromium-headless-shell or
// chromium) is absent, where FRICTAB_AXE does not name axe-core's axe.min.js (npm install
// axe-core), or pdftotext (poppler-utils).
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file_streams.h"
#include "support/run_command.h"

namespace frictab::browser_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_command;
using test::run_frictab;
using testing::HasSubstr;

constexpr const char* house = FRICTAB_SOURCE_DIR;

std::string chromium() {
  for (const char* path : {"/usr/bin/chromium-headless-shell", "/usr/bin/chromium"})
    if (fs::exists(path)) return path;
  return "";
}

CommandResult browse(const std::string& page, std::vector<std::string> flags) {
  std::vector<std::string> argv{chromium(),          "--headless",
                                "--no-sandbox",      "--disable-gpu",
                                "--hide-scrollbars", "--virtual-time-budget=20000"};
  argv.insert(argv.end(), flags.begin(), flags.end());
  argv.push_back("file://" + page);
  return run_command(argv);
}

// The stress of the first row that `frictab predict` prints.
double tau_in(const std::string& csv) {
  std::istringstream lines(csv);
  std::string titles, first, title, value;
  std::getline(lines, titles);
  std::getline(lines, first);
  std::istringstream names(titles), values(first);
  while (std::getline(names, title, ',') && std::getline(values, value, ','))
    if (title == "tau_R_MPa") return std::stod(value);
  return std::nan("");
}

class SlowPagesInBrowser : public testing::Test {
protected:
  void SetUp() override {
    if (chromium().empty()) GTEST_SKIP() << "Chromium is not installed";
  }

  // Of one synthetic campaign with a traced effect: a report, the data, a study; and the
  // documentation.
  void make_pages() {
    run({"twin", "twin", "--law", "log_coulomb", "--design",
         "p=500,1625,2750;psi=1,5;v=5,500;T=20,200;points=40;validation=6", "--effect",
         "form=saturation,column=s_mm,strength=0.3,x0=3"});
    run({"run", "twin/job.toml", "--set", "models.use=[\"log_coulomb\", \"coulomb\", \"orowan\"]",
         "--set", "export.targets=c"});
    run({"data", "twin/job.toml"});
    directory.write("study.toml", "job = \"study_job.toml\"\ndirectory = \"study\"\n"
                                  "stage = \"calibrate\"\n[[twin]]\nname = \"t\"\nseed = \"1..4\"\n"
                                  "design = \"p=1725,2005;psi=1,20;v=5,500;T=20;points=10\"\n"
                                  "factors = { oil = \"a\" }\n");
    directory.write("study_job.toml", "[models]\nuse = [\"coulomb\", \"shear\"]\n");
    run({"study", "run", "study.toml"});
    run({"study", "report", "study.toml"});
    pages = {directory.path("twin/out/report.html"), directory.path("twin/out/data.html"),
             directory.path("study/report.html"), directory.path("twin/out/explore.html")};
    if (!build_site()) return;
    for (const char* page : {"index", "start", "measurements", "laws"})
      pages.push_back(directory.path("site/" + std::string(page) + ".html"));
  }

  // False where Sphinx is not installed.
  bool build_site() const {
    if (run_command({"/bin/sh", "-c", "command -v sphinx-build"}).exit_code != 0) return false;
    const CommandResult built =
        run_command({std::string(house) + "/docs/build", directory.path("site")}, "",
                    {"FRICTAB=" + test::program()});
    EXPECT_EQ(built.exit_code, 0) << built.err;
    return true;
  }

  // What `script` makes of a page: it sets document.title.
  std::string said(const std::string& page, const std::string& script,
                   const std::vector<std::string>& flags) const {
    std::string text = io::read_file(page);
    text.insert(text.rfind("</body>"), "<script>document.querySelectorAll('details').forEach(d => "
                                       "d.open = true);</script>" +
                                           script);
    const std::string changed = fs::path(page).replace_filename("changed.html").string();
    std::ofstream(changed) << text; // beside the page, whose style it takes
    const std::string dom = [&] {
      std::vector<std::string> all{"--dump-dom"};
      all.insert(all.end(), flags.begin(), flags.end());
      return browse(changed, all).out;
    }();
    const std::size_t title = dom.find("<title>");
    if (title == dom.npos) return "no page";
    return dom.substr(title + 7, dom.find("</title>", title) - title - 7);
  }

  void run(const std::vector<std::string>& arguments) const {
    const CommandResult result = run_frictab(arguments, directory.path());
    ASSERT_EQ(result.exit_code, 0) << arguments[0] << result.err;
  }

  test::TemporaryDirectory directory;
  std::vector<std::string> pages;
};

// Chromium's headless shell has windows of any width; where there is only Chromium, which has none
// below 500 pixels, it is that.
const std::string narrow = "--window-size=400,900";

TEST_F(SlowPagesInBrowser, HaveNoFindingsOfAxe) {
  const char* axe = std::getenv("FRICTAB_AXE");
  if (!axe) GTEST_SKIP() << "FRICTAB_AXE does not name axe.min.js of axe-core";
  ASSERT_NO_FATAL_FAILURE(make_pages());
  pages.resize(4); // those of the documentation are a theme's
  const std::string script =
      "<script>" + io::read_file(axe) +
      "</script><script>axe.run().then(r => { document.title = 'axe: ' + r.violations.length + ' ' "
      "+ JSON.stringify(r.violations.map(v => v.id + ' ' + v.nodes[0].html)); });</script>";
  for (const std::string& page : pages)
    for (const std::string size : {"--window-size=1400,900", narrow.c_str()})
      for (const char* scheme : {"1", "0"}) // light, dark
        EXPECT_THAT(said(page, script,
                         {size, std::string("--blink-settings=preferredColorScheme=") + scheme}),
                    HasSubstr("axe: 0 "))
            << page << " " << size << " " << scheme;
}

TEST_F(SlowPagesInBrowser, FitAPhone) {
  ASSERT_NO_FATAL_FAILURE(make_pages());
  const std::string script =
      "<script>document.title = document.documentElement.scrollWidth - innerWidth</script>";
  for (const std::string& page : pages)
    EXPECT_EQ(said(page, script, {narrow}), "0") << page << " is wider than its window by so much";
}

TEST_F(SlowPagesInBrowser, ExploreShowsTheValuesOfTheProgram) {
  ASSERT_NO_FATAL_FAILURE(make_pages());
  const std::string page = pages[3];
  // Its slider of the contact normal stress is moved; then title: states, laws with their stress.
  const std::string script =
      "<script>get('states').querySelector('input[type=number]').value = 777;"
      "get('states').querySelector('input[type=number]').onchange();"
      "document.title = Object.entries(view.at).flat().concat(Array.from("
      "document.querySelectorAll('#values tbody tr'), r => [r.dataset.law, r.dataset.tau]).flat())"
      ".join(' ');</script>";
  std::istringstream words(said(page, script, {"--window-size=1400,900"}));
  std::map<std::string, std::string> states;
  std::size_t compared = 0;
  for (std::string name, value; words >> name >> value;) {
    const std::string model = directory.path("twin/out/models/" + name + ".json");
    if (!fs::exists(model)) {
      states[name] = value;
      continue;
    }
    std::string header = "experiment", row = "a";
    for (const auto& [state, at] : states) {
      header += "," + state;
      row += "," + at;
    }
    directory.write("rows.csv", header + "\n" + row + "\n" + row + "\n");
    const double tau = tau_in(run_frictab({"predict", model, "rows.csv"}, directory.path()).out);
    EXPECT_NEAR(std::stod(value), tau, 1e-12 * tau) << name;
    ++compared;
  }
  EXPECT_EQ(states.at("sigma_n_MPa"), "777");
  EXPECT_GE(compared, 2U);
}

TEST_F(SlowPagesInBrowser, ExploreMarksTheTestsOfARangeWithoutAPointer) {
  ASSERT_NO_FATAL_FAILURE(make_pages());
  const std::string script =
      "<script>get('from').value = 1000; get('from').onchange();"
      "const wrong = test_points.filter(({t, x}) => view.marked.has(t) !== (x >= 1000)).length;"
      "const some = view.marked.size; get('clear').onclick();"
      "document.title = [wrong, some > 0 && some < data.tests.length, view.marked.size,"
      "location.hash.includes('marked')].join(' ');</script>";
  EXPECT_EQ(said(pages[3], script, {"--window-size=1400,900"}), "0 true 0 false");
}

TEST_F(SlowPagesInBrowser, PrintEverySectionAndNoEmptyPage) {
  if (run_command({"sh", "-c", "command -v pdftotext"}).exit_code != 0)
    GTEST_SKIP() << "pdftotext is not installed";
  ASSERT_NO_FATAL_FAILURE(make_pages());
  std::vector<std::string> printed;
  for (const std::string& page : pages) {
    browse(page, {"--no-pdf-header-footer", "--print-to-pdf=" + directory.path("page.pdf")});
    printed.push_back(run_command({"pdftotext", "-layout", directory.path("page.pdf"), "-"}).out);
    std::size_t from = 0; // pages end in a form feed
    for (std::size_t end = 0; (end = printed.back().find('\f', from)) != std::string::npos;
         from = end + 1)
      EXPECT_NE(printed.back().substr(from, end - from).find_first_not_of(" \n"), std::string::npos)
          << page << " has an empty page";
  }
  // What is folded on the screen: laws but the first, strokes that trained, the wiring.
  for (const char* text : {"2. log_coulomb", "Orowan: Coulomb friction limited by shear friction",
                           "Trained on: 24 tests", "E024", "frictab_tau_R.c"})
    EXPECT_THAT(printed[0], HasSubstr(text));
  EXPECT_THAT(printed[2], HasSubstr("m of shear"));
}

TEST_F(SlowPagesInBrowser, AreSearchedFromDisk) {
  if (!build_site()) GTEST_SKIP() << "Debian's python3-sphinx is not installed";
  EXPECT_THAT(browse(directory.path("site/search.html?q=wanheim"), {"--dump-dom"}).out,
              HasSubstr("<a href=\"start.html"));
}

} // namespace
} // namespace frictab::browser_test
