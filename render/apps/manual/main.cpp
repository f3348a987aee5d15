// boule_manual FOLDER SOURCE: writes the manual pages, in Markdown, and the completions of the
// shells into FOLDER, from the command line's own options and the documents in SOURCE/docs.
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "render/apps/cli/process/messages.h"
#include "render/apps/manual/completions.h"
#include "render/apps/manual/man_pages.h"

namespace {

using namespace boule;
using namespace boule::manual;

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

void write_all(const std::string& folder, const std::string& source) {
  const std::string functions = source + "/render/apps/manual/functions", docs = source + "/docs";
  const std::vector<CommandFacts> commands = command_facts();
  const auto pages =
      man_pages(commands, read(docs + "/command_line.md"), read(docs + "/scene_format.md"));
  if (!pages) throw std::runtime_error(pages.error().message);
  for (const auto& [name, text] : pages.value()) write(folder + "/" + name + ".md", text);
  write(folder + "/boule.bash", bash_completion(commands, read(functions + ".bash")));
  write(folder + "/_boule", zsh_completion(commands));
  write(folder + "/boule.fish", fish_completion(commands, read(functions + ".fish")));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::runtime_error("usage: boule_manual FOLDER SOURCE");
    write_all(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    cli::print_note(std::string("boule_manual: ") + error.what());
    return 1;
  }
}
