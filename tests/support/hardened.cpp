#include "support/hardened.h"

#include <regex>
#include <stdexcept>

#include "io/file_streams.h"
#include "support/run_command.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FRICTAB_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
#define FRICTAB_SANITIZED
#endif

namespace frictab::test {

namespace {

#ifdef FRICTAB_SANITIZED
constexpr bool is_hardened_build = false;
#else
constexpr bool is_hardened_build = true;
#endif

#ifdef __x86_64__
// Targets of indirect calls begin with endbr64. The note that the whole program has them would need
// a C library that was built so, which Debian 12 has not.
constexpr const char* landing_pad = "\xf3\x0f\x1e\xfa";
constexpr std::size_t least_landing_pads = 1000;

std::size_t landing_pads(const std::string& program) {
  const std::string bytes = io::read_file(program);
  std::size_t count = 0;
  for (std::size_t at = 0; (at = bytes.find(landing_pad, at)) != bytes.npos; ++at)
    ++count;
  return count;
}
#endif

} // namespace

std::vector<std::string> protections_missing_in(const std::string& program) {
  const CommandResult read = run_command({"readelf", "-hldW", "--dyn-syms", program});
  if (read.exit_code != 0) throw std::runtime_error(read.err);
  std::vector<std::string> missing;
  const auto has = [&](const char* pattern) {
    return std::regex_search(read.out, std::regex(pattern));
  };
  if (has("\\((RPATH|RUNPATH)\\)")) missing.push_back("libraries by the system's paths alone");
  if (!is_hardened_build) return missing;
  if (!has("Type: +DYN ")) missing.push_back("code at any address (PIE)");
  if (!has("GNU_RELRO")) missing.push_back("relocations that become read-only (RELRO)");
  if (!has("BIND_NOW|\\bNOW\\b")) missing.push_back("relocations before the start (BIND_NOW)");
  if (!has("__stack_chk_fail")) missing.push_back("stack protector");
  if (!has(" __(?!stack)\\w+_chk\\b")) missing.push_back("_FORTIFY_SOURCE");
#ifdef __x86_64__
  if (landing_pads(program) < least_landing_pads) missing.push_back("control-flow protection");
#endif
  return missing;
}

} // namespace frictab::test
