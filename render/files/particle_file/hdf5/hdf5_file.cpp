#include "render/files/particle_file/hdf5/hdf5_file.h"

#include <new>
#include <utility>

#include "render/image/module/module_search.h"

namespace boule {
namespace {

using hdf5_module::Table;

Result<const Table*> open_hdf5_module() {
  auto table = open_module<Table>("boule_hdf5.so", hdf5_module::version_mark,
                                  hdf5_module::entry_point, hdf5_module::version);
  if (table) return table;
  return Diagnostic::of("cannot read HDF5: " + table.error().message + "; Debian's package " +
                        modules_package + " has it; a build has it if libhdf5-dev is there");
}

/// The values of an attribute.
struct AttributeValues {
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

void add_attribute_number(void* context, double number) {
  static_cast<AttributeValues*>(context)->numbers.push_back(number);
}
void add_attribute_text(void* context, const char* bytes, std::size_t count) {
  static_cast<AttributeValues*>(context)->texts.emplace_back(std::string_view(bytes, count));
}

using CodeNames = std::map<double, std::string>;
void add_code_name(void* context, double code, const char* name) {
  static_cast<CodeNames*>(context)->emplace(code, name);
}

using TakeText = std::function<void(std::string_view)>;
void pass_text_on(void* context, const char* bytes, std::size_t count) {
  (*static_cast<const TakeText*>(context))(std::string_view(bytes, count));
}

}  // namespace

Result<std::unique_ptr<Hdf5File>> Hdf5File::open(const std::string& path) {
  const auto table = open_hdf5_module();
  if (!table) return table.error();
  hdf5_module::File* const file = table.value()->open(path.c_str());
  if (file == nullptr) throw std::bad_alloc();
  std::unique_ptr<Hdf5File> opened(new Hdf5File(*table.value(), file));
  if (const std::string text = table.value()->error(file); !text.empty())
    return Diagnostic::of(text);
  return Result<std::unique_ptr<Hdf5File>>(std::move(opened));
}

Hdf5File::~Hdf5File() { table_.close(file_); }

Diagnostic Hdf5File::error(const std::string& path) const {
  return Diagnostic::of(quote(path, 200) + ": " + table_.error(file_));
}

Hdf5Object Hdf5File::look(const std::string& path) const {
  Hdf5Object object{};
  table_.look(file_, path.c_str(), &object);
  return object;
}

bool Hdf5File::has_group(const std::string& path) const {
  return look(path).kind == Hdf5Kind::group;
}

Diagnostic Hdf5File::refusal(const std::string& path) const {
  static_cast<void>(look(path));
  return error(path);
}

Result<std::vector<std::string>> Hdf5File::list(const std::string& group) const {
  AttributeValues names;
  if (!has_group(group)) return names.texts;
  if (!table_.list(file_, group.c_str(), add_attribute_text, &names)) return error(group);
  return std::move(names.texts);
}

std::vector<double> Hdf5File::numbers_of(const std::string& path,
                                         const std::string& attribute) const {
  AttributeValues values;
  table_.attribute(file_, path.c_str(), attribute.c_str(), add_attribute_number, add_attribute_text,
                   &values);
  return std::move(values.numbers);
}

std::vector<std::string> Hdf5File::texts_of(const std::string& path,
                                            const std::string& attribute) const {
  AttributeValues values;
  table_.attribute(file_, path.c_str(), attribute.c_str(), add_attribute_number, add_attribute_text,
                   &values);
  return std::move(values.texts);
}

Result<std::map<double, std::string>> Hdf5File::names_of(const std::string& path) const {
  CodeNames names;
  if (!table_.names(file_, path.c_str(), add_code_name, &names)) return error(path);
  return names;
}

Status Hdf5File::read(const std::string& path, const Hdf5Extent& start, const Hdf5Extent& count,
                      double* to) const {
  if (table_.read(file_, path.c_str(), start.data(), count.data(), to)) return {};
  return error(path);
}

Status Hdf5File::read_texts(const std::string& path, const Hdf5Extent& start,
                            const Hdf5Extent& count, const TakeText& take) const {
  TakeText own = take;
  if (table_.read_texts(file_, path.c_str(), start.data(), count.data(), pass_text_on, &own))
    return {};
  return error(path);
}

}  // namespace boule
