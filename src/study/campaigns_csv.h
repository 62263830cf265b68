// campaigns.csv: one row per campaign and law.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "study/plan.h"
#include "study/result.h"

namespace frictab::study {

// Whether the file has a column of this name that is not a factor.
bool is_campaigns_column(std::string_view name);

void write_header(std::ostream& out, const Study& study);
// Writes a row per law. Parameters and their errors are lists, "mu=0.1;n=0.4"; effects are listed
// by their columns.
void write_rows(std::ostream& out, const Campaign& campaign, std::uint64_t key,
                const CampaignResult& result);
// Writes one row without a law; `message`: of a failure, else empty.
void write_row_without(std::ostream& out, const Campaign& campaign, std::uint64_t key, State state,
                       const std::string& message);

} // namespace frictab::study
