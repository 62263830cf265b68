// What a message says when memory runs out: the work that was under way, how much of it, and what
// would make it smaller.
#pragma once

#include <cstddef>
#include <new>
#include <string>
#include <utility>

namespace frictab {

// The remedy where rows need the memory.
inline constexpr const char* fewer_rows =
    "every row is held in memory: data.condense = 880 holds means over blocks of each test "
    "instead, "
    "which say as much of slow friction as all rows; or name fewer bystanders";

// Where they are read one experiment at a time.
inline constexpr const char* one_experiment_at_a_time =
    "data that are condensed are read one experiment at a time: the largest one does not find "
    "room; "
    "a file per test, or shorter tests; fewer threads (-j) hold fewer at once";

// Instead of the std::bad_alloc of `large_work`; `what()` is "out of memory ...".
class OutOfMemory : public std::bad_alloc {
public:
  OutOfMemory(const std::string& doing, std::size_t rows, std::string hint);
  const char* what() const noexcept override { return text_.c_str(); }
  const std::string& hint() const { return hint_; }

private:
  std::string text_, hint_;
};

// What `work` returns. Where memory runs out in it: OutOfMemory, of the innermost such work.
// `doing` follows "out of memory ": "reading a.csv (1.2 GiB)". `rows`: that are held in memory by
// then; the message says what one takes.
template <class Work>
auto large_work(const std::string& doing, std::size_t rows, const char* hint, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw OutOfMemory(doing, rows, hint);
  }
}

} // namespace frictab
