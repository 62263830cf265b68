// Turns exceptions about one routine into its record.
#include "verify/broken.h"

#include <new>
#include <sstream>
#include <system_error>

#include "core/error.h"
#include "core/program.h"

namespace frictab::verify {

namespace {

constexpr std::size_t most_lines = 8; // of a compiler, of which the first ones say what is wrong

// Leaves out the directory in which the routine was compiled: it has another name each time.
std::string without_directory(std::string message) {
  const std::string place = (temporary_place() / "frictab-").string();
  for (std::size_t at = 0; (at = message.find(place, at)) != message.npos;) {
    const std::size_t end = message.find('/', at + place.size());
    message.erase(at, (end == message.npos ? at + place.size() : end + 1) - at);
  }
  return message;
}

std::string beginning(const std::string& message) {
  std::istringstream lines(without_directory(message));
  std::string text, line;
  for (std::size_t n = 0; n < most_lines && std::getline(lines, line); ++n)
    text += (text.empty() ? "" : "\n") + line;
  return std::getline(lines, line) ? text + "\n..." : text;
}

} // namespace

bool can_run(DriftRecord& record, const codegen::BuildVariant& variant) {
  record.ran = have_program(variant.program());
  if (!record.ran) record.why_not = "there is no " + variant.program() + " on this machine";
  return record.ran;
}

DriftRecord or_broken(const std::string& model, const std::string& subject, double allowed_MPa,
                      const std::function<DriftRecord()>& verify) {
  try {
    return verify();
  } catch (const InputError&) {
    throw;
  } catch (const std::system_error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    DriftRecord record;
    record.model = model;
    record.subject = subject;
    record.ran = false;
    record.broken = true;
    record.why_not = "cannot be compiled or called: " + beginning(error.what());
    record.allowed_MPa = allowed_MPa;
    return record;
  }
}

} // namespace frictab::verify
