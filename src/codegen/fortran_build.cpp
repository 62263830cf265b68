// The flags of gfortran, and a replacement for the routine that ends an analysis.
#include "codegen/fortran_build.h"

#include <set>

#include "codegen/combine.h"
#include "codegen/fortran_stop.h"
#include "codegen/source_check.h"

namespace frictab::codegen::fortran {

BuildVariant library_variant(const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags) {
  BuildVariant out;
  out.name = name;
  out.eps = eps;
  out.command = compile_flags("gfortran", ".f");
  out.command.insert(out.command.begin(), "gfortran");
  out.command.insert(out.command.end(), {"-fPIC", "-shared"});
  out.command.insert(out.command.end(), flags.begin(), flags.end());
  out.command.insert(out.command.end(), {"-o", "@{out}"});
  for (const std::string& source : sources)
    out.command.push_back("@{dir}/" + source);
  return out;
}

void add_source(BuildVariant& variant, const std::string& file, const std::string& text) {
  variant.command.push_back("@{dir}/" + file);
  variant.extra[file] = text;
}

BuildVariant fortran_variant(const ExportRequest& request, const std::string& name, double eps,
                             const std::vector<std::string>& sources,
                             const std::vector<std::string>& flags, bool quits) {
  BuildVariant out = library_variant(name, eps, {}, flags);
  if (quits || ends(request)) {
    std::string stand_ins;
    for (const std::string& letters : std::set<std::string>{entry_stem(request), stem(request)})
      stand_ins += "C     Stand-in: comes back, where the bundle's own ends the analysis.\n"
                   "      subroutine " +
                   letters +
                   "quit(text)\n"
                   "      character*(*) text\n"
                   "      end\n";
    out.command.push_back("-Wl,-z,muldefs"); // the linker takes the first of two definitions
    add_source(out, "ftquit.f", stand_ins);
  }
  for (const std::string& source : sources)
    out.command.push_back("@{dir}/" + source);
  return out;
}

} // namespace frictab::codegen::fortran
