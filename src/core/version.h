// Which frictab this is: it stands in every file it writes.
#pragma once

namespace frictab {

// "0.1.0+g1a2b3c4d5e" of that commit; with ".dirty" behind it where files were changed since;
// "0.1.0" where the sources know no commit. CMake writes it (version.cmake).
const char* tool_version();

} // namespace frictab
