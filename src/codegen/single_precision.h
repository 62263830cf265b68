// Generated code in single precision: the option that asks for it, and C texts with double numbers
// turned into such with float numbers.
#pragma once

#include <string>
#include <string_view>

#include "codegen/exporter.h"

namespace frictab::codegen {

// "double", "single"; of targets that can write both.
ExportOption precision_option();
bool wants_single(const ExportRequest& request);

// A kernel in single precision holds its values itself, since device code reads no file. Throws
// InputError where they are more than a source takes.
void check_single_size(const ExportRequest& request);

// The float nearest to a number, and never 0 for one that is not: numbers below the smallest normal
// one become that. Throws InputError above the largest float.
float single_value(double value);

// It as C writes it: 1.0f, 1e-20f; reads back to the same bits.
std::string single_number(double value);

// C code in single precision from the same in double: types, numbers and the functions of math.h
// are those of float. Comments stay as they are. Throws InputError as single_value does.
std::string in_single_precision(std::string_view code);

} // namespace frictab::codegen
