// A self-contained page of sections that opens offline.
#pragma once

#include <string>
#include <vector>

#include "words/document.h"

namespace frictab::report {

struct Page {
  std::string title;
  std::string kicker;                // what kind of page, above the title
  std::vector<words::Text> warnings; // at the top, in a colour of their own
  words::Section first;              // before the menu
  std::vector<words::Section> sections;
};

// Sections without blocks are left out.
std::string html_of(const Page& page);

// Warning of pages on data that nobody measured.
words::Text synthetic_warning();

} // namespace frictab::report
