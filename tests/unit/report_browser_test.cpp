// The page in a real browser, judged by axe-core. Neither is needed to build or to use frictab: the
// tests skip where Chromium is absent, or where FRICTAB_AXE does not name axe-core's axe.min.js.
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>

#include "io/atomic_file.h"
#include "report_sample.h"
#include "support/run_command.h"

namespace frictab::report_browser_test {

namespace {

std::string chromium() {
  for (const char* path : {"/usr/bin/chromium-headless-shell", "/usr/bin/chromium"})
    if (std::filesystem::exists(path)) return path;
  return "";
}

// What axe-core finds, as the browser's title: "axe: N [ids]".
std::string axe_findings(const std::string& axe, const std::string& flag) {
  test::TemporaryDirectory directory;
  std::string page = report::report_html(test::report_sample(15, 6, 100).input());
  const std::string script =
      "<script>" + io::read_file(axe) +
      "</script><script>axe.run().then(r => { document.title = 'axe: ' + r.violations.length + ' ' "
      "+ JSON.stringify(r.violations.map(v => v.id + ' ' + v.nodes[0].html)); });</script>";
  page.insert(page.find("</body>"), script);
  directory.write("page.html", page);
  const std::string dom =
      test::run_command({chromium(), "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom",
                         "--virtual-time-budget=20000", flag,
                         "file://" + directory.path("page.html")})
          .out;
  const std::size_t title = dom.find("<title>");
  return title == dom.npos ? "no page" : dom.substr(title, dom.find("</title>", title) - title);
}

} // namespace

TEST(SlowReportInBrowser, HasNoFindingsOfAxe) {
  const char* axe = std::getenv("FRICTAB_AXE");
  if (chromium().empty()) GTEST_SKIP() << "Chromium is not installed";
  if (!axe) GTEST_SKIP() << "FRICTAB_AXE does not name axe.min.js of axe-core";
  for (const char* flag : {"--window-size=1400,900", "--window-size=400,900",
                           "--blink-settings=preferredColorScheme=0"})
    EXPECT_THAT(axe_findings(axe, flag), testing::HasSubstr("axe: 0 ")) << flag;
}

} // namespace frictab::report_browser_test
