// Parses i/n.
#include "core/shard.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/error.h"

namespace frictab {

Shard read_shard(const std::string& text) {
  Shard shard;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto read = [](std::string_view part, std::uint64_t& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size() && value > 0;
  };
  const std::string_view all(text);
  if (slash < text.size() && read(all.substr(0, slash), shard.number) &&
      read(all.substr(slash + 1), shard.of) && shard.number <= shard.of)
    return shard;
  throw InputError({"--shard", 0, 0}, fmt::format("'{}' is not a shard", text),
                   "write i/n with i from 1 to n: --shard 3/8");
}

} // namespace frictab
