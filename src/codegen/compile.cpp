// Runs compilers by posix_spawn and loads what they made.
#include "codegen/compile.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "codegen/prefix.h"
#include "core/text.h"

extern char** environ;

namespace frictab::codegen {

namespace {

namespace fs = std::filesystem;

void write_files(const SourceBundle& files, const fs::path& directory) {
  for (const auto& [path, content] : files) {
    fs::create_directories((directory / path).parent_path());
    std::ofstream out(directory / path, std::ios::binary);
    out << content;
    out.close();
    if (!out) throw std::runtime_error("cannot write " + (directory / path).string());
  }
}

std::string file_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Standard output and error of the program go to `log`. Gives the exit status of waitpid.
int run(const std::vector<std::string>& command, const fs::path& log) {
  std::vector<char*> argv;
  for (const std::string& word : command)
    argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw std::runtime_error("cannot run " + command[0] + ": " + std::strerror(failed));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error("lost " + command[0] + " while it ran");
  return status;
}

} // namespace

bool have_program(const std::string& name) {
  if (name.empty()) return true;
  if (name.find('/') != std::string::npos) return access(name.c_str(), X_OK) == 0;
  const char* path = std::getenv("PATH");
  std::istringstream directories(path ? path : "/usr/bin:/bin");
  for (std::string directory; std::getline(directories, directory, ':');)
    if (access((directory + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

void run_program(const std::vector<std::string>& command, const fs::path& log) {
  const int status = run(command, log);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(join(command, " ") + "\n" + file_text(log));
}

fs::path compile_library(const SourceBundle& bundle, const BuildVariant& variant,
                         const fs::path& work_dir) {
  const fs::path directory = fs::absolute(work_dir);
  const fs::path library = directory / ("lib" + variant.name + ".so");
  const fs::path log = directory / (variant.name + ".log");
  fs::create_directories(directory);
  write_files(bundle, directory);
  write_files(variant.extra, directory);
  std::vector<std::string> command;
  for (const std::string& word : variant.command)
    command.push_back(
        replace_all(replace_all(word, "@{out}", library.string()), "@{dir}", directory.string()));
  run_program(command, log);
  return library;
}

Library::Library(const fs::path& file) : handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw std::runtime_error(dlerror());
}

Library::~Library() {
  dlclose(handle_);
}

void* Library::address(void* handle, const std::string& symbol) {
  void* found = dlsym(handle, symbol.c_str());
  if (!found) throw std::runtime_error("no symbol '" + symbol + "' in the compiled library");
  return found;
}

void Library::tell_directory(const fs::path& directory, const std::string& symbol) const {
  if (void* tell = dlsym(handle_, symbol.c_str()))
    reinterpret_cast<void (*)(const char*)>(tell)(directory.c_str());
}

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (fs::temp_directory_path() / "frictab-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary directory");
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

CompiledTarget::CompiledTarget(const Exporter& exporter, const ExportRequest& request,
                               const SourceBundle& bundle, const BuildVariant& variant)
    : exporter_(exporter), request_(request), variant_(variant) {
  if (variant.command.empty()) {
    write_files(bundle, directory_.path());
    return;
  }
  library_.emplace(compile_library(bundle, variant, directory_.path()));
  // The option is there for all targets of a job, and not all follow it.
  for (const std::string& symbol :
       {std::string("frictab_directory"), prefixed(request, "frictab_directory")})
    library_->tell_directory(directory_.path(), symbol);
}

} // namespace frictab::codegen
