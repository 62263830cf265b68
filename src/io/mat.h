// MATLAB files: version 4 to 7 by libmatio, version 7.3 by HDF5. Both libraries can crash on
// damaged files and therefore run in a child process.
#pragma once

#include <filesystem>
#include <string>

#include "core/os/isolated.h"
#include "io/column_groups.h"

namespace frictab::io {

// True for a MATLAB header, or for the extension .mat unless the file is plain HDF5.
bool looks_like_mat(const std::filesystem::path& file);

// Reads the whole file. Variables are members of the root: row and column vectors, char matrices
// and cells of texts as columns; the columns of a matrix as NAME(:,1) ..; scalars and texts as
// single values; logical as 0 and 1. A struct is a group, an element of a struct array NAME(1) ..
// and of a cell of structs NAME{1} .. too; the structs of a struct without columns are groups
// OUTER.INNER, other structs within one give members INNER.NAME. Tables and objects, function
// handles, sparse and complex matrices are not read (`other_type`). Throws InputError for damaged
// files.
ColumnGroups read_mat(const std::filesystem::path& file, const std::string& named);

// The output of the child that reads a file: written there, and taken here. take_groups returns
// false if the bytes cannot come from a file of `file_bytes`; otherwise `fault` may explain why
// there are no groups.
void put_groups(const ColumnGroups& all, const std::string& fault, os::ByteSink& out);
bool take_groups(os::ByteSource& in, std::uint64_t file_bytes, ColumnGroups& all,
                 std::string& fault);

} // namespace frictab::io
