// Samples chunks in parallel into a work file whose head becomes that of an HDF5 file at the end.
#include "table/stream.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/stat.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/version.h"
#include "table/chunk_list.h"
#include "table/sampling.h"
#include "table/table_file.h"
#include "table/tolerance.h"

namespace frictab::table {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t chunk_nodes = std::size_t{1} << 20;
constexpr std::uint64_t values_at = std::uint64_t{1} << 20; // byte; what is before belongs to HDF5

fs::path beside(const fs::path& file, const char* ending) {
  return file.parent_path() / ("." + file.filename().string() + ending);
}

std::string hex_hash(const std::string& text) {
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}
std::uint64_t hash_of(std::span<const double> values) {
  return XXH3_64bits(values.data(), values.size_bytes());
}

// Everything the bytes of the values depend on.
std::string job_line(const models::AssembledLaw& law, const Table& table) {
  std::string text = tool_version() + expr::to_text(law.piece);
  for (const double parameter : law.model.parameters)
    text += " " + shortest(parameter);
  for (const TableAxis& axis : table.axes) {
    text += "\n" + axis.name + (axis.log ? " log" : "");
    for (const double node : axis.nodes)
      text += " " + shortest(node);
  }
  text += table.log_value ? "\nlog" : "";
  return fmt::format("frictab/partial/2 {} {} nodes, {} per chunk", hex_hash(text), table.nodes(),
                     chunk_nodes);
}

// Positive on a coarse grid of the same range: ends, kinks of coarse axes, some between.
bool is_positive(const Pieces& pieces, const std::vector<StateRange>& ranges,
                 std::vector<TableAxis> axes) {
  for (TableAxis& axis : axes) {
    const std::vector<double> nodes = axis.nodes;
    const std::size_t most = std::min<std::size_t>(5, nodes.size());
    axis.nodes.resize(most);
    for (std::size_t i = 0; i < most; ++i)
      axis.nodes[i] = nodes[i * (nodes.size() - 1) / (most - 1)];
  }
  std::vector<double> values(count_nodes(axes));
  sample_nodes(pieces, ranges, axes, 0, values);
  return *std::min_element(values.begin(), values.end()) > 0;
}

class Sampler {
public:
  Sampler(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
          const TableOptions& options)
      : ranges_(ranges), pieces_(law, ranges), place_(options.place) {
    auto axes = fixed_axes(law, ranges, options).value();
    const bool log_value = law.model.law->log_value && is_positive(pieces_, ranges, axes);
    table = describe_table(law, ranges, std::move(axes), Interpolation::linear, log_value);
    table.record.tolerance_MPa = options.tolerance_MPa.value_or(usual_tolerance_MPa);
    if (!options.tolerance_from.empty()) table.record.tolerance_from = options.tolerance_from;
    table.record.refinement = "every axis has the number of nodes that the job says";
  }

  std::size_t chunks() const { return (table.nodes() + chunk_nodes - 1) / chunk_nodes; }
  std::size_t first(std::size_t chunk) const { return chunk * chunk_nodes; }
  std::size_t size(std::size_t chunk) const {
    return std::min(chunk_nodes, table.nodes() - first(chunk));
  }

  std::vector<double> values(std::size_t chunk) const {
    std::vector<double> out(size(chunk));
    for (std::size_t i = 0; i < out.size(); i += sample_block) {
      const auto block = std::span(out).subspan(i, std::min(sample_block, out.size() - i));
      sample_nodes(pieces_, ranges_, table.axes, first(chunk) + i, block);
      check_finite(table, first(chunk) + i, block, place_);
    }
    return out;
  }

  Table table;

private:
  const std::vector<StateRange>& ranges_;
  Pieces pieces_;
  Place place_;
};

// Lists of the shards of this table that are there.
std::vector<fs::path> shard_lists(const fs::path& file) {
  const std::string start = beside(file, ".chunks.").filename().string();
  std::vector<fs::path> lists;
  std::error_code none; // no directory: no lists
  for (const auto& entry : fs::directory_iterator(file.parent_path(), none))
    if (entry.path().filename().string().starts_with(start)) lists.push_back(entry.path());
  std::sort(lists.begin(), lists.end());
  return lists;
}

// Chunks whose bytes in the file still have the hash that was listed for them.
std::vector<char> kept_chunks(const Sampler& sampler, const Chunks& listed,
                              const io::StoredValues& stored) {
  std::vector<char> kept(sampler.chunks(), 0);
  const std::vector<std::pair<std::size_t, std::uint64_t>> found(listed.begin(), listed.end());
  const Progress progress("checking what is there", found.size());
  parallel_for(found.size(), [&](std::size_t i) {
    const auto [chunk, hash] = found[i];
    if (chunk >= kept.size()) return;
    std::vector<double> values(sampler.size(chunk));
    stored.read(sampler.first(chunk), values);
    kept[chunk] = hash_of(values) == hash;
    progress.tick();
  });
  return kept;
}

std::uint64_t bytes_on_disk(const fs::path& file) {
  struct stat status = {};
  return ::stat(file.c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_blocks) * 512
                                            : 0;
}

std::string grid_text(const Table& table) {
  std::vector<std::string> counts;
  for (const TableAxis& axis : table.axes)
    counts.push_back(fmt::format("{} {}", axis.name, axis.nodes.size()));
  return fmt::format("{} nodes: {}", thousands(table.nodes()), join(counts, ", "));
}

void check_room(const Table& table, const io::Hdf5Storage& storage, const fs::path& file) {
  const std::uint64_t values = sizeof(double) * std::uint64_t{table.nodes()};
  const std::uint64_t packed = storage.chunked() ? values : 0; // beside the work file
  const std::uint64_t wanted = values_at + values + packed;
  const std::uint64_t there = bytes_on_disk(beside(file, ".partial"));
  io::check_disk_space(file.parent_path(), wanted - std::min(there, wanted),
                       fmt::format("the table of {} ({})", table.model, grid_text(table)),
                       "fewer nodes in [table.axes], or another disk with -o DIR");
}

} // namespace

bool is_streamed(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                 const TableOptions& options) {
  const auto axes = fixed_axes(law, ranges, options);
  if (!axes || axes->empty()) return false;
  const double bytes = 8.0 * static_cast<double>(count_nodes(*axes));
  // HDF5 puts smaller datasets where it likes, not at values_at.
  if (bytes <= std::max(options.memory_limit_MiB * (1 << 20), static_cast<double>(values_at)))
    return false;
  if (options.interpolation == Interpolation::cubic)
    throw InputError(options.place,
                     fmt::format("a cubic table of {} nodes ({}) is larger than "
                                 "table.memory_limit_MiB = {}: the coefficients of a spline "
                                 "follow from all values at once",
                                 thousands(count_nodes(*axes)), human_bytes(bytes),
                                 shortest(options.memory_limit_MiB)),
                     "table.interpolation = \"linear\", fewer nodes, or a larger "
                     "table.memory_limit_MiB");
  return true;
}

namespace {

using StoredTogether = std::shared_ptr<const io::StoredValues>;

// Samples those of the `wanted` chunks that are not kept, and lists them. Gives how many were kept.
std::size_t sample_chunks(const Sampler& sampler, const std::vector<std::size_t>& wanted,
                          const Chunks& listed, const ChunkList& list, const io::ValuesFile& out,
                          const io::StoredValues& stored) {
  const std::vector<char> kept = kept_chunks(sampler, listed, stored);
  std::vector<std::size_t> open;
  for (const std::size_t chunk : wanted)
    if (!kept[chunk]) open.push_back(chunk);
  const std::size_t there = wanted.size() - open.size();
  const Progress progress("sampling " + sampler.table.model, wanted.size(), there);
  parallel_for(open.size(), [&](std::size_t i) {
    const std::vector<double> values = sampler.values(open[i]);
    out.write(sampler.first(open[i]), values);
    list.add(open[i], hash_of(values));
    progress.tick();
  });
  return there;
}

StoredTogether stored_values(const fs::path& work, const Sampler& sampler) {
  return std::make_shared<const io::StoredValues>(work, work.string(), values_at,
                                                  sampler.table.nodes());
}

} // namespace

StreamedTable stream_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                           const TableOptions& options, const fs::path& file) {
  Sampler sampler(law, ranges, options);
  check_room(sampler.table, options.hdf5, file);
  fs::create_directories(file.parent_path());
  const fs::path work = beside(file, ".partial");
  const std::string job = job_line(law, sampler.table);
  const ChunkList list(beside(file, ".chunks"), job);
  Chunks listed = list.found();
  std::deque<ChunkList> of_shards; // held until the table is complete
  for (const fs::path& shard : shard_lists(file)) {
    const Chunks& found = of_shards.emplace_back(shard, job).found();
    listed.insert(found.begin(), found.end());
  }
  if (listed.empty()) fs::remove(work); // of another job
  const io::ValuesFile out(work, values_at, sampler.table.nodes());
  const StoredTogether stored = stored_values(work, sampler);
  std::vector<std::size_t> all(sampler.chunks());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::size_t kept = sample_chunks(sampler, all, listed, list, out, *stored);
  sampler.table.stored = stored;
  return {std::move(sampler.table), all.size(), kept};
}

SampledShard sample_shard(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                          const TableOptions& options, const fs::path& file, const Shard& shard) {
  const Sampler sampler(law, ranges, options);
  check_room(sampler.table, options.hdf5, file);
  fs::create_directories(file.parent_path());
  const std::string job = job_line(law, sampler.table);
  std::vector<fs::path> others = shard_lists(file);
  others.push_back(beside(file, ".chunks"));
  for (const fs::path& other : others)
    if (in_use_for_another_job(other, job))
      throw InputError({other.string(), 0, 0},
                       "another frictab is writing this table, of another job",
                       "wait for it, or choose another directory with -o DIR");
  const std::string ending = fmt::format(".chunks.{}-of-{}", shard.number, shard.of);
  const ChunkList list(beside(file, ending.c_str()), job);
  const fs::path work = beside(file, ".partial");
  const io::ValuesFile out(work, values_at, sampler.table.nodes());
  SampledShard done;
  std::vector<std::size_t> wanted;
  for (std::size_t chunk = 0; chunk < sampler.chunks(); ++chunk)
    if (shard.has(chunk)) {
      wanted.push_back(chunk);
      done.nodes += sampler.size(chunk);
    }
  done.chunks = wanted.size();
  done.kept =
      sample_chunks(sampler, wanted, list.found(), list, out, *stored_values(work, sampler));
  return done;
}

namespace {

// An HDF5 file with a hole in place of its values, laid over the work file: a kill at any moment
// leaves values that the list of chunks still fits.
void write_head(const Table& table, const fs::path& file) {
  const fs::path head = beside(file, ".head"), work = beside(file, ".partial");
  {
    io::Hdf5Writer out(head, values_at);
    out.reserve("value", table.shape());
    write_description(out, table);
    out.close();
  }
  if (io::Hdf5Reader(head, head.string()).raw_offset("value") != values_at)
    throw std::runtime_error("HDF5 puts the values of " + head.string() + " elsewhere");
  const std::uint64_t behind = values_at + sizeof(double) * std::uint64_t{table.nodes()};
  const std::uint64_t end = fs::file_size(head);
  const io::ValuesFile out(work, values_at, table.nodes());
  std::ifstream in(head, std::ios::binary);
  const auto copy = [&](std::uint64_t from, std::uint64_t to) {
    std::vector<char> bytes(to - from);
    in.seekg(static_cast<std::streamoff>(from));
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
      throw std::runtime_error("cannot read " + head.string());
    out.write_bytes(from, bytes);
  };
  out.resize(end);
  copy(0, values_at);
  copy(behind, end);
  fs::remove(head);
}

} // namespace

namespace {

// What users get, read back.
void compare_with_work_file(const fs::path& packed, const io::StoredValues& values) {
  std::vector<double> sampled;
  io::Hdf5Reader(packed, packed.string())
      .blocks("value", chunk_nodes, [&](std::size_t first, std::span<const double> part) {
        sampled.resize(part.size());
        values.read(first, sampled);
        if (std::memcmp(sampled.data(), part.data(), part.size_bytes()) != 0)
          throw std::runtime_error("the disk gives back something else than was written to " +
                                   packed.string());
      });
}

} // namespace

fs::path finish_stream(const Table& table, const io::Hdf5Storage& storage, const fs::path& file) {
  if (!storage.chunked()) {
    write_head(table, file);
    return beside(file, ".partial");
  }
  const fs::path packed = beside(file, ".packed");
  io::Hdf5Writer out(packed);
  Progress progress("packing " + table.model, table.nodes());
  out.dataset(
      "value", table.shape(),
      [&](std::size_t first, std::span<double> values) {
        table.stored->read(first, values);
        progress.tick(values.size());
      },
      storage);
  write_description(out, table);
  out.close();
  compare_with_work_file(packed, *table.stored);
  return packed;
}

std::vector<std::string> work_files(const fs::path& file) {
  std::vector<std::string> names;
  for (const char* ending : {".partial", ".chunks", ".head", ".packed"})
    names.push_back(beside(file, ending).filename().string());
  for (const fs::path& list : shard_lists(file))
    names.push_back(list.filename().string());
  return names;
}

} // namespace frictab::table
