#include "render/files/particle_file/bridge/bridge_reader.h"

#include <memory>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "render/files/particle_file/bridge/boule_read.h"
#include "render/files/particle_file/bridge/child_process.h"
#include "render/files/particle_file/bridge/frame_answer.h"
#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/frame/particle_format.h"

namespace boule {
namespace {

/// The program that runs boule-read.
std::string& python() {
  static std::string program = "/usr/bin/python3";
  return program;
}

/// The names of files in the table of boule-read: endings, and beginnings with a '*'.
std::vector<std::string_view> names_in_table() {
  std::string_view table(boule_read_script);
  constexpr std::string_view begin = "FORMATS = \"\"\"\n";
  table.remove_prefix(table.find(begin) + begin.size());
  table = table.substr(0, table.find("\"\"\""));
  std::vector<std::string_view> names;
  for (const std::string_view row : words_of(table, "\n")) {
    const auto more = words_of(row.substr(0, row.find('|')));
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

class BridgeReader final : public ParticleReader {
 public:
  BridgeReader(std::unique_ptr<ChildProcess> process, BridgeHead head, ParticleFileOptions options)
      : process_(std::move(process)), head_(std::move(head)), options_(std::move(options)) {}

  [[nodiscard]] std::size_t frames() const override { return head_.frames; }

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor&) override {
    if (!process_) return Diagnostic::of("boule-read has ended");
    if (auto done = process_->send("frame " + std::to_string(frame) + "\n"); !done) {
      process_.reset();
      return done.error();
    }
    auto answer = read_frame(*process_, options_);
    if (!answer.goes_on) process_.reset();
    if (!answer.value) return answer.value.error();
    ParticleFrame read = std::move(answer.value).value();
    if (!read.species) guess_species(read);
    leave_out_unwanted(options_.wanted, read);
    read.notes.push_back("read by " + head_.library);
    return read;
  }

 private:
  std::unique_ptr<ChildProcess> process_;  ///< none: it has failed
  BridgeHead head_;
  ParticleFileOptions options_;
};

Result<std::unique_ptr<ParticleReader>> open_bridge(const std::string& path,
                                                    const ParticleFileOptions& options,
                                                    std::size_t particles) {
  std::vector<std::string> words{python(), "-c", std::string(boule_read_script), path,
                                 std::to_string(particles)};
  if (options.wanted) {
    words.emplace_back("only");
    words.insert(words.end(), options.wanted->begin(), options.wanted->end());
  }
  auto process = ChildProcess::start(words);
  if (!process) {
    return Diagnostic::of("it needs Python, and " + quote(python(), 300) + " does not start: " +
                          process.error().message + "; BOULE_PYTHON names another");
  }
  auto head = read_head(*process.value());
  if (!head) return head.error();
  if (head.value().frames == 0) return Diagnostic::of("it holds no frames");
  return std::unique_ptr<ParticleReader>(
      std::make_unique<BridgeReader>(std::move(process).value(), std::move(head).value(), options));
}

bool is_bridge_name(std::string_view name) {
  for (const std::string_view one : names_in_table()) {
    if (one.ends_with('*') ? name.starts_with(one.substr(0, one.size() - 1))
                           : name.ends_with("." + std::string(one))) {
      return true;
    }
  }
  return false;
}

}  // namespace

void set_bridge_python(std::string program) { python() = std::move(program); }

constinit const ParticleFormat library_format = {.name = "library",
                                                 .is_trajectory = true,
                                                 .names_columns = true,
                                                 .knows_name = is_bridge_name,
                                                 .open_file = open_bridge};

}  // namespace boule
