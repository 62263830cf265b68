// Messages for exhausted memory: the work under way, its size, and how to make it smaller.
#pragma once

#include <cstddef>
#include <new>
#include <string>
#include <utility>

namespace frictab {

// Remedy if all rows are in memory.
inline constexpr const char* fewer_rows =
    "every row is held in memory: data.condense = 880 holds means over blocks of each test "
    "instead, which say as much of slow friction as all rows; or name fewer bystanders";

// Remedy if the rows are read one experiment at a time.
inline constexpr const char* one_experiment_at_a_time =
    "data that are condensed are read one experiment at a time: the largest one does not find "
    "room; a file per test, or shorter tests; fewer threads (-j) hold fewer at once";

// Thrown by `large_work` in place of std::bad_alloc; `what()` is "out of memory ...".
class OutOfMemory : public std::bad_alloc {
public:
  OutOfMemory(const std::string& doing, std::size_t rows, std::string hint);
  const char* what() const noexcept override { return text_.c_str(); }
  const std::string& hint() const { return hint_; }

private:
  std::string text_, hint_;
};

// Returns the result of `work`. If memory runs out in it, throws OutOfMemory for the innermost such
// work. `doing` follows "out of memory " in the message: "reading a.csv (1.2 GiB)". `rows`: number
// of rows in memory by then; the message gives the memory per row.
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
