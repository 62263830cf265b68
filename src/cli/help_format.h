// Help in 80 columns: descriptions are broken at blanks and continue in their own column. Short
// (-h): options and commands with the first clause of their descriptions; long (--help): all of it,
// examples and exit codes.
#pragma once

#include <memory>
#include <sstream>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/text.h"
#include "core/wrapped.h"

namespace frictab::cli {

class HelpFormat : public CLI::Formatter {
public:
  // `names`: width of the names on the left.
  explicit HelpFormat(std::size_t names) { column_width(names); }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    is_short_ = mode == CLI::AppFormatMode::Normal;
    return CLI::Formatter::make_help(app, std::move(name), CLI::AppFormatMode::Normal);
  }
  std::string make_option(const CLI::Option* option, bool by_place) const override {
    return line(make_option_name(option, by_place) + make_option_opts(option),
                make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return line(command->get_display_name(true), command->get_description());
  }
  // Removes a mark of the library, "--no-progress{false}".
  std::string make_option_name(const CLI::Option* option, bool by_place) const override {
    return replace_all(CLI::Formatter::make_option_name(option, by_place), "{false}", "");
  }
  std::string make_footer(const CLI::App* command) const override {
    if (is_short_) return "--help has more: examples, exit codes\n";
    std::istringstream lines(command->get_footer());
    std::string out;
    for (std::string text; std::getline(lines, text);)
      out += footer_line(text) + "\n";
    return out;
  }

private:
  mutable bool is_short_ = false; // during make_help

  std::string line(const std::string& name, const std::string& description) const {
    const std::size_t indent = get_column_width();
    std::string text = "  " + name;
    text = characters(text) + 2 > indent ? text + "\n" + std::string(indent, ' ')
                                         : fmt::format("{:<{}}", text, indent);
    const std::string shown =
        is_short_ ? description.substr(0, description.find(';')) : description;
    return text + wrapped(shown, page_width, indent) + "\n";
  }
  // Puts an example's explanation above it where both do not fit in one line.
  static std::string footer_line(const std::string& text) {
    if (characters(text) <= page_width) return text;
    const std::size_t mark = text.find("  # ");
    if (mark == text.npos) return wrapped(text, page_width, 0);
    return text.substr(mark) + "\n" + text.substr(0, text.find_last_not_of(' ', mark) + 1);
  }
};

} // namespace frictab::cli
