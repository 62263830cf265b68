// Prints sections (document.h) on a terminal, as Markdown, as HTML and as JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "words/document.h"

namespace frictab::words {

// Terminal text: a line per paragraph or item; the contents of a section indented by two blanks;
// columns aligned. ASCII, except in texts of users.
std::string as_text(const Section& section);

// Markdown as GitHub and GitLab render it; the section's title is a heading of this level.
std::string as_markdown(const Section& section, int level = 2);

// HTML that is well-formed XML as well, without scripts or anything from outside.
std::string as_html(const Section& section, int level = 2);
// Links to the sections that have a name for the menu.
std::string menu_html(const std::vector<Section>& sections);
std::string html_of(const Text& text);

// {"title": ..., "lines": [...], "tables": [{"columns": [...], "rows": [[...]]}]}; nested sections
// under "sections". Texts as on a terminal.
nlohmann::ordered_json as_json(const Section& section);

// Makes text safe for HTML, XML and SVG; replaces what no XML may hold by U+FFFD.
std::string escape(std::string_view text);

} // namespace frictab::words
