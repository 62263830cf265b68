// The flags of gfortran, and a replacement for the routine that ends an analysis.
#include "codegen/fortran_build.h"

#include <set>

#include "codegen/combine.h"
#include "codegen/fortran_stop.h"
#include "codegen/source_check.h"

namespace frictab::codegen::fortran {

std::vector<std::string> library_command(const std::vector<std::string>& flags) {
  std::vector<std::string> command = compile_flags("gfortran", ".f");
  command.insert(command.begin(), "gfortran");
  command.insert(command.end(), {"-fPIC", "-shared"});
  command.insert(command.end(), flags.begin(), flags.end());
  command.insert(command.end(), {"-o", "@{out}"});
  return command;
}

BuildVariant fortran_variant(const ExportRequest& request, const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags, bool quits) {
  BuildVariant out;
  out.name = name;
  out.eps = eps;
  out.command = library_command(flags);
  // The linker takes the first of two definitions.
  if (quits || ends(request)) {
    out.command.insert(out.command.end(), {"-Wl,-z,muldefs", "@{dir}/ftquit.f"});
    for (const std::string& letters : std::set<std::string>{entry_stem(request), stem(request)})
      out.extra["ftquit.f"] +=
          "C     Stand-in: comes back, where the bundle's own ends the analysis.\n"
          "      subroutine " +
          letters +
          "quit(text)\n"
          "      character*(*) text\n"
          "      end\n";
  }
  for (const std::string& source : sources)
    out.command.push_back("@{dir}/" + source);
  return out;
}

} // namespace frictab::codegen::fortran
