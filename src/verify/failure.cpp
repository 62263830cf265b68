// Writes faults as JUnit.
#include "verify/failure.h"

#include <sstream>

#include <pugixml.hpp>

#include "core/text.h"
#include "core/version.h"

namespace frictab::verify {

std::string failure_junit(const std::vector<Fault>& faults) {
  pugi::xml_document document;
  pugi::xml_node suite = document.append_child("testsuites").append_child("testsuite");
  const auto attribute = [](pugi::xml_node node, const char* name, const std::string& text) {
    node.append_attribute(name) = printable(text).c_str();
  };
  attribute(suite, "name", "frictab verify");
  for (const char* count : {"tests", "errors"})
    suite.append_attribute(count) = static_cast<unsigned>(faults.size());
  suite.append_attribute("failures") = 0;
  pugi::xml_node version = suite.append_child("properties").append_child("property");
  attribute(version, "name", "tool_version");
  attribute(version, "value", tool_version());
  for (const Fault& fault : faults) {
    const std::string place = format_place(fault.place);
    pugi::xml_node test = suite.append_child("testcase");
    attribute(test, "classname", place.empty() ? "verify" : place);
    attribute(test, "name", fault.what);
    attribute(test.append_child("error"), "message",
              (place.empty() ? "" : place + ": ") + fault.what +
                  (fault.hint.empty() ? "" : "; hint: " + fault.hint));
  }
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

} // namespace frictab::verify
