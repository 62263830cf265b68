// Workbooks by hand: XML files in a ZIP archive.
#pragma once

#include <string>

#include "support/run_command.h"

namespace frictab::test {

// A workbook of one sheet in `directory`. `rows`: Python that sets `rows`, a list of lists of texts
// and numbers, at most six in each. False where it could not be written (no python3).
inline bool write_workbook(const TemporaryDirectory& directory, const std::string& name,
                           const std::string& rows) {
  const std::string script = R"(
import csv, sys, zipfile
)" + rows + R"(
cell = lambda c: ('t="inlineStr"><is><t>%s</t></is>' % c if isinstance(c, str) else '><v>%r</v>' % c)
xml = ''.join('<row r="%d">%s</row>' % (i + 1, ''.join('<c r="%s%d" %s</c>' % ('ABCDEF'[j], i + 1, cell(c))
              for j, c in enumerate(row))) for i, row in enumerate(rows))
main = 'http://schemas.openxmlformats.org/spreadsheetml/2006/main'
rel = 'http://schemas.openxmlformats.org/officeDocument/2006/relationships'
package = 'http://schemas.openxmlformats.org/package/2006/'
sheet = 'application/vnd.openxmlformats-officedocument.spreadsheetml.'
with zipfile.ZipFile(sys.argv[1], 'w') as z:
    z.writestr('[Content_Types].xml', '<Types xmlns="%scontent-types"><Override PartName="/xl/workbook.xml" ContentType="%ssheet.main+xml"/><Override PartName="/xl/worksheets/sheet1.xml" ContentType="%sworksheet+xml"/></Types>' % (package, sheet, sheet))
    z.writestr('_rels/.rels', '<Relationships xmlns="%srelationships"><Relationship Id="r1" Type="%s/officeDocument" Target="xl/workbook.xml"/></Relationships>' % (package, rel))
    z.writestr('xl/workbook.xml', '<workbook xmlns="%s" xmlns:r="%s"><sheets><sheet name="1" sheetId="1" r:id="rId1"/></sheets></workbook>' % (main, rel))
    z.writestr('xl/_rels/workbook.xml.rels', '<Relationships xmlns="%srelationships"><Relationship Id="rId1" Type="%s/worksheet" Target="worksheets/sheet1.xml"/></Relationships>' % (package, rel))
    z.writestr('xl/worksheets/sheet1.xml', '<worksheet xmlns="%s"><sheetData>%s</sheetData></worksheet>' % (main, xml))
)";
  directory.write("make.py", script);
  return run_command({"/usr/bin/python3", "make.py", name}, directory.path()).exit_code == 0;
}

} // namespace frictab::test
