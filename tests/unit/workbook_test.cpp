// Workbooks as Excel and other writers store them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "io/number_format.h"
#include "io/workbook.h"
#include "io/zip_archive.h"
#include "support/run_command.h"
#include "support/workbook.h"

namespace frictab::workbook_test {

namespace {

using io::CellKind;
using test::number_cell;
using test::text_cell;
using test::XmlCell;
using test::XmlWorkbook;
using testing::HasSubstr;

class Workbook : public testing::Test {
protected:
  io::Sheet sheet(const XmlWorkbook& book, const std::string& name = "A") {
    test::write_workbook(path_, book);
    return io::Workbook(path_, "a.xlsx").read(name);
  }
  std::string fault(const std::function<void()>& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  std::string fault_of_parts(std::map<std::string, std::string> parts) {
    test::write_archive(path_, parts);
    return fault([&] { io::Workbook(path_, "a.xlsx").read("A"); });
  }

  test::TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_.path("a.xlsx");
};

TEST_F(Workbook, GivesNumbersByTheirValueAndNotByTheirFormat) {
  const XmlWorkbook book{
      {{"A", test::xml_row(1, {text_cell("F [kN]"), number_cell("1583.794037051374", 1),
                               number_cell("2.5E-3", 2)})}},
      {"#,##0 \"kN\"", "0.0"}};
  const io::Sheet cells = sheet(book);
  EXPECT_EQ(cells.text, "\"F [kN]\",1583.794037051374,2.5E-3\n");
  EXPECT_EQ(cells.kind(1, 0), CellKind::number);
  EXPECT_EQ(cells.kind(7, 7), CellKind::empty);
}

TEST_F(Workbook, GivesFractionsSecondsAndDates) {
  const XmlWorkbook book{
      {{"A", test::xml_row(1, {number_cell("0.453", 1), number_cell("5.787037037037037e-07", 2),
                               number_cell("1.5", 3), number_cell("46083.5", 4),
                               number_cell("46083", 4)})}},
      {"0.0%", "ss.000", "[h]:mm:ss", "dd/mm/yyyy\\ hh:mm"}};
  const io::Sheet cells = sheet(book);
  EXPECT_EQ(cells.text, "0.453,0.05,129600,2026-03-02T12:00:00,2026-03-02\n");
  EXPECT_EQ(cells.kind(0, 0), CellKind::percent);
  EXPECT_EQ(cells.kind(1, 0), CellKind::time);
  EXPECT_EQ(cells.kind(3, 0), CellKind::date);
}

TEST_F(Workbook, CountsDaysFrom1904WhereItSaysSo) {
  XmlWorkbook book{{{"A", test::xml_row(1, {number_cell("0", 1)})}}, {"yyyy"}};
  book.properties = "date1904=\"1\"";
  EXPECT_EQ(sheet(book).text, "1904-01-01\n");
}

TEST_F(Workbook, JoinsTheRunsOfATextAndLeavesPhoneticGuidesOut) {
  XmlWorkbook book{{{"A", test::xml_row(1, {{"t=\"s\"", "<v>0</v>"}, {"t=\"s\"", "<v>1</v>"}})}}};
  book.strings = {"<r><t>Rei</t></r><r><rPr/><t xml:space=\"preserve\">bung </t></r>"
                  "<rPh><t>x</t></rPh>",
                  "<t>a,b&#10;c</t>"};
  EXPECT_EQ(sheet(book).text, "\"Reibung \",\"a,b c\"\n");
}

TEST_F(Workbook, KeepsRowsAndColumnsWhereTheyAre) {
  const XmlWorkbook book{
      {{"A", test::xml_row(3, {{}, {}, number_cell("7")}) + test::xml_row(5, {number_cell("8")})}}};
  EXPECT_EQ(sheet(book).text, "\n\n,,7\n\n8\n");
}

TEST_F(Workbook, NeedsNoReferencesAndNoOrder) {
  const XmlWorkbook book{
      {{"A",
        "<row r=\"2\"><c><v>3</v></c><c><v>4</v></c></row><row r=\"1\"><c r=\"B1\"><v>2</v></c>"
        "<c r=\"A1\"><v>1</v></c></row>"}}};
  EXPECT_EQ(sheet(book).text, "1,2\n3,4\n");
}

TEST_F(Workbook, GivesEveryCellOfAMergedAreaItsValue) {
  XmlWorkbook book{
      {{"A", test::xml_rows("Kraft;;Weg\nSoll;Ist;\n1;2;3\n"),
        "<mergeCells><mergeCell ref=\"A1:B1\"/><mergeCell ref=\"C1:C2\"/></mergeCells>"}}};
  const io::Sheet cells = sheet(book);
  EXPECT_EQ(cells.text, "Kraft,Kraft,Weg\nSoll,Ist,Weg\n1,2,3\n");
  EXPECT_EQ(cells.merged_cells, 2u);
}

TEST_F(Workbook, CountsFormulasThatWereNeverCalculated) {
  const XmlWorkbook book{
      {{"A", test::xml_row(1, {{"", "<f>1+1</f><v>2</v>"}, {"", "<f>1+2</f>"}})}}};
  const io::Sheet cells = sheet(book);
  EXPECT_EQ(cells.text, "2\n");
  EXPECT_EQ(cells.uncalculated, 1u);
}

TEST_F(Workbook, ReadsNamesInAnyPrefix) {
  auto parts = test::workbook_parts({{{"A", test::xml_rows("x;y\n1;2\n")}}});
  std::string& xml = parts["xl/worksheets/sheet1.xml"];
  for (const char* name : {"worksheet", "sheetData", "row", "c ", "is", "t ", "v"})
    xml = replace_all(replace_all(xml, std::string("<") + name, std::string("<x:") + name),
                      "</" + std::string(name).substr(0, std::string(name).find(' ')) + ">",
                      "</x:" + std::string(name).substr(0, std::string(name).find(' ')) + ">");
  test::write_archive(path_, parts);
  EXPECT_EQ(io::Workbook(path_, "a.xlsx").read("A").text, "x,y\n1,2\n");
}

TEST_F(Workbook, NamesItsSheetsAndSaysWhichAreHidden) {
  test::write_workbook(path_, {{{"Übersicht", ""}, {"B", "", "", "veryHidden"}}});
  const io::Workbook book(path_, "a.xlsx");
  ASSERT_EQ(book.sheets().size(), 2u);
  EXPECT_EQ(book.sheets()[0].name, "Übersicht");
  EXPECT_FALSE(book.sheets()[0].hidden);
  EXPECT_TRUE(book.sheets()[1].hidden);
  EXPECT_THAT(fault([&] { book.read("Ubersicht"); }),
              testing::AllOf(HasSubstr("a.xlsx: error: holds no sheet 'Ubersicht'"),
                             HasSubstr("'Übersicht'")));
}

TEST_F(Workbook, RefusesWhatIsNoneWithTheWayOut) {
  EXPECT_THAT(fault_of_parts({{"content.xml", "<a/>"}}), HasSubstr("Save as, Excel 2007-365"));
  EXPECT_THAT(fault_of_parts({{"xl/workbook.bin", "x"}}), HasSubstr("(.xlsb)? Save it as .xlsx"));
  EXPECT_THAT(fault_of_parts({{"a.csv", "x"}}), HasSubstr("unpack it, and name the files in it"));
  directory_.write("a.xlsx", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1 and more");
  EXPECT_THAT(fault([&] { io::Workbook(path_, "a.xlsx"); }),
              HasSubstr("an old workbook (.xls), or one with a password"));
}

TEST_F(Workbook, RefusesAnArchiveThatUnfoldsToFarMoreThanItsSize) {
  auto parts = test::workbook_parts({{{"A", ""}}});
  parts["xl/worksheets/sheet1.xml"] =
      "<worksheet><!--" + std::string(std::size_t{40} << 20, ' ') + "--></worksheet>";
  EXPECT_THAT(fault_of_parts(parts), HasSubstr("would unfold to 40 MiB from"));
}

TEST_F(Workbook, RefusesCellsThatNoSheetHas) {
  auto parts = test::workbook_parts({{{"A", "<row r=\"1\"><c r=\"XFE1\"><v>1</v></c></row>"}}});
  EXPECT_THAT(fault_of_parts(parts), HasSubstr("there is no cell 'XFE1' in a sheet"));
  parts = test::workbook_parts({{{"A", test::xml_row(1, {{"t=\"s\"", "<v>3</v>"}})}}});
  EXPECT_THAT(fault_of_parts(parts), HasSubstr("a cell names text 3 of 0"));
  parts["xl/worksheets/sheet1.xml"] = "<worksheet><sheetData>";
  EXPECT_THAT(fault_of_parts(parts), HasSubstr("'xl/worksheets/sheet1.xml' in it is damaged"));
  parts.erase("xl/worksheets/sheet1.xml");
  EXPECT_THAT(fault_of_parts(parts), HasSubstr("lacks the cells of its sheet 'A'"));
}

TEST_F(Workbook, RefusesMergedAreasThatWouldFillMemory) {
  XmlWorkbook book{
      {{"A", test::xml_row(1, {number_cell("1")}) + test::xml_row(1048576, {number_cell("2")}),
        "<mergeCells><mergeCell ref=\"A1:XFD1048576\"/></mergeCells>"}}};
  EXPECT_THAT(fault([&] { sheet(book); }), HasSubstr("more than a million cells"));
}

TEST_F(Workbook, NeedsNoMemoryForEmptyCellsAboveTheLastRow) {
  std::vector<XmlCell> names, numbers;
  for (int i = 0; i < 16384; ++i) {
    names.push_back(text_cell(fmt::format("n{}", i)));
    numbers.push_back(number_cell("1"));
  }
  const io::Sheet last =
      sheet({{{"A", test::xml_row(1048575, names) + test::xml_row(1048576, numbers)}}});
  std::size_t runs = 0;
  for (const auto& column : last.kinds)
    runs += column.size();
  EXPECT_EQ(runs, 2 * 16384u);
  EXPECT_EQ(last.kind(16383, 1048575), CellKind::number);
  EXPECT_EQ(last.kind(16383, 1048574), CellKind::text);
  EXPECT_EQ(last.kind(16383, 1048573), CellKind::empty);
  EXPECT_EQ(last.kind(16384, 1048575), CellKind::empty);
}

TEST_F(Workbook, RefusesALongTextThatManyCellsShare) {
  XmlWorkbook book{{{"A", ""}}};
  book.strings = {"<t>" + std::string(std::size_t{4} << 20, 'a') + "</t>"};
  for (std::size_t row = 1; row <= 300; ++row)
    book.sheets[0].rows += test::xml_row(row, {{"t=\"s\"", "<v>0</v>"}});
  EXPECT_THAT(fault([&] { sheet(book); }), HasSubstr("larger than 1 GiB as text"));
}

TEST_F(Workbook, RefusesSheetsThatAreOneFile) {
  auto parts = test::workbook_parts({{{"A", ""}, {"B", ""}}});
  parts["xl/_rels/workbook.xml.rels"] =
      replace_all(parts["xl/_rels/workbook.xml.rels"], "sheet2.xml", "sheet1.xml");
  EXPECT_THAT(fault_of_parts(parts), HasSubstr("its sheets 'A' and 'B' are one file in it"));
}

TEST_F(Workbook, RefusesAnArchiveWhoseFilesAreTooLargeTogether) {
  test::write_archive(path_, {{"a", std::string(1000, 'a')}, {"b", std::string(1000, 'b')}});
  io::ZipLimits limits;
  limits.all_bytes = 2000;
  EXPECT_EQ(fault([&] { io::ZipArchive(path_, "a.xlsx", limits); }), "no fault");
  limits.all_bytes = 1999;
  EXPECT_THAT(fault([&] { io::ZipArchive(path_, "a.xlsx", limits); }),
              HasSubstr("its files would unfold to more than"));
}

// Every truncation, and flipped bytes all over the archive.
TEST_F(Workbook, IsReadOrRefusedHoweverItIsDamaged) {
  test::write_workbook(path_, {{{"A", test::xml_rows("x;y\n1;2\n")}}, {"0%"}});
  const std::string whole = directory_.read("a.xlsx");
  Random random(5);
  std::size_t refused = 0, read = 0;
  const auto attempt = [&](const std::string& bytes) {
    directory_.write("b.xlsx", bytes);
    try {
      io::Workbook(directory_.path("b.xlsx"), "b.xlsx").read("A");
      ++read;
    } catch (const InputError&) {
      ++refused;
    }
  };
  for (std::size_t size = 0; size < whole.size(); size += 3)
    attempt(whole.substr(0, size));
  for (int i = 0; i < 500; ++i) {
    std::string bytes = whole;
    bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
    attempt(bytes);
  }
  EXPECT_GT(refused, whole.size() / 3);
  EXPECT_GT(read, 10u);
}

TEST(NumberFormat, TellsTimesDatesAndPercentFromNumbers) {
  for (const char* code : {"General", "0.00", "#,##0.0 \"mm/s\"", "0.00E+00", "[Red]-0.0", "@",
                           "0.0 \"h\"", "_-* #,##0\\ \\d_-", "[$-407]0"})
    EXPECT_EQ(io::kind_of_format(code), CellKind::number) << code;
  for (const char* code : {"h:mm", "[h]:mm:ss", "mm:ss.0", "[s]", "ss.000", "hh:mm AM/PM"})
    EXPECT_EQ(io::kind_of_format(code), CellKind::time) << code;
  for (const char* code : {"dd.mm.yyyy", "yyyy-mm-dd\\ hh:mm:ss", "mmm", "[$-409]d-mmm-yy;@"})
    EXPECT_EQ(io::kind_of_format(code), CellKind::date) << code;
  EXPECT_EQ(io::kind_of_format("0.0%"), CellKind::percent);
  EXPECT_EQ(io::kind_of_built_in_format(9), CellKind::percent);
  EXPECT_EQ(io::kind_of_built_in_format(14), CellKind::date);
  EXPECT_EQ(io::kind_of_built_in_format(46), CellKind::time);
  EXPECT_EQ(io::kind_of_built_in_format(4), CellKind::number);
}

TEST(NumberFormat, CountsDaysAsExcelDoes) {
  EXPECT_EQ(io::date_text(61, false), "1900-03-01");
  EXPECT_EQ(io::date_text(59, false), "1900-02-28");
  EXPECT_EQ(io::date_text(1, false), "1900-01-01");
  EXPECT_EQ(io::date_text(46083.609583333, false), "2026-03-02T14:37:48");
  EXPECT_EQ(io::date_text(46083 + 0.2 / 86400, false), "2026-03-02T00:00:00.200");
  EXPECT_EQ(io::date_text(-1, false), "-1");
}

} // namespace

} // namespace frictab::workbook_test
