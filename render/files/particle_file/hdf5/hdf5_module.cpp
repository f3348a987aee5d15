// The module that reads files of HDF5. What a file may not have it do: follow links into other
// files, read datasets whose bytes are in other files, load filters.
#include "render/files/particle_file/hdf5/hdf5_module.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "render/files/particle_file/hdf5/hdf5_values.h"

namespace boule::hdf5_module {

/// A dataset that stays open, with its chunks.
struct Dataset {
  hid_t id = H5I_INVALID_HID;
  Object object{};
};

struct File {
  hid_t id = H5I_INVALID_HID;
  std::string error{};
  std::map<std::string, Dataset, std::less<>> datasets{};
};

namespace {

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// For as long as it lives the library is this thread's, and does not print.
class Hold {
 public:
  Hold() : lock_(library_mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &context_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() { H5Eset_auto2(H5E_DEFAULT, print_, context_); }

 private:
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* context_ = nullptr;
};

herr_t refuse_file(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) {
  return -1;
}

/// How objects are found: not in other files.
hid_t within_file(hid_t kind) {
  Handle list(checked(H5Pcreate(kind)));
  checked(H5Pset_elink_cb(list.id(), refuse_file, nullptr));
  return list.release();
}

/// Whether there is such an object; of links into other files, Failure.
bool is_there(const File& file, const std::string& path) {
  const Handle access(within_file(H5P_LINK_ACCESS));
  for (std::size_t end = 0; end != std::string::npos;) {
    end = path.find('/', end + 1);
    const std::string part = path.substr(0, end);
    if (part == "/") continue;
    if (checked(H5Lexists(file.id, part.c_str(), access.id())) == 0) return false;
    H5L_info_t link{};
    checked(H5Lget_info(file.id, part.c_str(), &link, access.id()));
    if (link.type > H5L_TYPE_SOFT)
      throw Failure{"it is in another file: links there are not followed"};
    const htri_t found = H5Oexists_by_name(file.id, part.c_str(), access.id());
    if (found < 0) throw Failure{"its link is not followed"};
    if (found == 0) return false;
    H5O_info_t object{};
    checked(H5Oget_info_by_name(file.id, part.c_str(), &object, access.id()));
    if (end != std::string::npos && object.type != H5O_TYPE_GROUP) return false;
  }
  return true;
}

/// Filters of others would be loaded from wherever the library looks for them.
void check_filters(hid_t list) {
  const int filters = checked(H5Pget_nfilters(list));
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter = H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &values,
                                               nullptr, 0, nullptr, nullptr);
    if (filter < H5Z_FILTER_DEFLATE || filter > H5Z_FILTER_SCALEOFFSET)
      throw Failure{"it is packed by filter " + std::to_string(filter) +
                    ", not one of HDF5 itself"};
  }
}

/// Sets the bytes of a chunk; refuses what is in other files.
void look_at_storage(hid_t dataset, hid_t type, Object& object) {
  const Handle list(checked(H5Dget_create_plist(dataset)));
  const H5D_layout_t layout = H5Pget_layout(list.id());
  if (layout == H5D_VIRTUAL)
    throw Failure{"it is virtual, made of other datasets: those are not read"};
  if (H5Pget_external_count(list.id()) != 0)
    throw Failure{"its bytes are in other files, which are not read"};
  if (layout != H5D_CHUNKED) return;
  check_filters(list.id());
  std::array<hsize_t, most_axes> extent{};
  checked(H5Pget_chunk(list.id(), static_cast<int>(most_axes), extent.data()));
  object.chunk_bytes = H5Tget_size(type);
  for (std::uint32_t i = 0; i < object.axes; ++i) object.chunk_bytes *= extent[i];
  constexpr std::uint64_t most = std::uint64_t{1} << 30;  // it is in memory as a whole
  if (object.chunk_bytes > most) throw Failure{"its chunks have more than 1 GiB"};
}

Object object_of(hid_t dataset) {
  Object object{};
  const Handle space(checked(H5Dget_space(dataset))), type(checked(H5Dget_type(dataset)));
  const int axes = H5Sget_simple_extent_ndims(space.id());
  object.kind = Kind::other;
  if (axes < 0 || axes > static_cast<int>(most_axes) ||
      H5Sget_simple_extent_type(space.id()) == H5S_NULL) {
    return object;
  }
  object.axes = static_cast<std::uint32_t>(axes);
  std::array<hsize_t, most_axes> extent{};
  checked(H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr));
  std::copy(extent.begin(), extent.end(), std::begin(object.extent));
  object.kind = kind_of(type.id());
  if (object.kind != Kind::other) look_at_storage(dataset, type.id(), object);
  return object;
}

/// A dataset that may be read. Large chunks are kept from one part to the next.
const Dataset& dataset_of(File& file, const char* path) {
  if (const auto found = file.datasets.find(std::string_view(path)); found != file.datasets.end())
    return found->second;
  constexpr std::size_t most_open = 64, usual = 1 << 20, largest = 256 << 20, slots = 521;
  if (file.datasets.size() >= most_open) {
    for (const auto& [name, one] : file.datasets) H5Idec_ref(one.id);
    file.datasets.clear();
  }
  const Handle access(within_file(H5P_DATASET_ACCESS));
  Handle dataset(checked(H5Dopen2(file.id, path, access.id())));
  const Object object = object_of(dataset.id());
  if (object.chunk_bytes > usual / 2 && object.chunk_bytes <= largest / 2) {
    checked(H5Pset_chunk_cache(access.id(), slots, 2 * object.chunk_bytes, 1));
    H5Idec_ref(dataset.release());
    Handle again(checked(H5Dopen2(file.id, path, access.id())));
    return file.datasets.emplace(path, Dataset{again.release(), object}).first->second;
  }
  return file.datasets.emplace(path, Dataset{dataset.release(), object}).first->second;
}

/// Calls `act`; false, with the reason in the file, if it fails.
template <class Act>
bool attempt(File* file, const Act& act) {
  const Hold hold;
  try {
    file->error.clear();
    act();
    return true;
  } catch (const Failure& failed) {
    file->error = failed.text;
  } catch (const std::bad_alloc&) {
    file->error = "it needs more memory than there is";
  }
  return false;
}

/// A part of a dataset, and its room in memory.
struct Part {
  Handle space, memory;
  std::size_t count;
};

Part part_of(const Dataset& dataset, const std::uint64_t* start, const std::uint64_t* count) {
  std::array<hsize_t, most_axes> first{}, extent{};
  hsize_t all = 1;
  for (std::uint32_t i = 0; i < dataset.object.axes; ++i) {
    first[i] = start[i];
    extent[i] = count[i];
    all *= count[i];
  }
  Part part{Handle(checked(H5Dget_space(dataset.id))),
            Handle(checked(H5Screate_simple(1, &all, nullptr))), static_cast<std::size_t>(all)};
  if (dataset.object.axes == 0) return part;
  checked(H5Sselect_hyperslab(part.space.id(), H5S_SELECT_SET, first.data(), nullptr, extent.data(),
                              nullptr));
  return part;
}

const char* library() {
  static const std::string text = [] {
    const Hold hold;
    unsigned a = 0, b = 0, c = 0;
    H5get_libversion(&a, &b, &c);
    return "HDF5 " + std::to_string(a) + "." + std::to_string(b) + "." + std::to_string(c);
  }();
  return text.c_str();
}

File* open(const char* path) {
  auto* const file = new (std::nothrow) File;
  if (file == nullptr) return nullptr;
  attempt(file, [&] { file->id = checked(H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT)); });
  return file;
}

void close(File* file) {
  {
    const Hold hold;
    for (const auto& [name, one] : file->datasets) H5Idec_ref(one.id);
    if (file->id >= 0) H5Fclose(file->id);
  }
  delete file;
}

const char* error(const File* file) { return file->error.c_str(); }

/// The names of a group.
struct Names {
  std::vector<std::string> all;
  bool are_too_many = false;
};

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* context) {
  constexpr std::size_t most = 1 << 16;
  auto& names = *static_cast<Names*>(context);
  try {
    names.are_too_many = names.all.size() >= most;
    if (names.are_too_many) return -1;
    names.all.emplace_back(name);
    return 0;
  } catch (const std::bad_alloc&) {  // none may reach the library
    return -1;
  }
}

bool list(File* file, const char* path, TakeText take, void* context) {
  return attempt(file, [&] {
    const Handle access(within_file(H5P_GROUP_ACCESS));
    const Handle group(checked(H5Gopen2(file->id, path, access.id())));
    const Handle made(checked(H5Gget_create_plist(group.id())));
    unsigned order = 0;
    checked(H5Pget_link_creation_order(made.id(), &order));
    const auto by = (order & H5P_CRT_ORDER_TRACKED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
    Names names;
    const herr_t done = H5Literate(group.id(), by, H5_ITER_INC, nullptr, add_name, &names);
    if (names.are_too_many) throw Failure{"it has too many names"};
    checked(done);
    for (const std::string& name : names.all) take(context, name.data(), name.size());
  });
}

bool look(File* file, const char* path, Object* object) {
  *object = {};
  const bool done = attempt(file, [&] {
    if (!is_there(*file, path)) return;
    const Handle access(within_file(H5P_LINK_ACCESS));
    const Handle found(checked(H5Oopen(file->id, path, access.id())));
    const H5I_type_t type = H5Iget_type(found.id());
    if (type == H5I_DATASET) {
      *object = dataset_of(*file, path).object;
    } else {
      object->kind = type == H5I_GROUP ? Kind::group : Kind::other;
    }
  });
  if (!done) object->kind = Kind::refused;
  return done;
}

bool attribute(File* file, const char* path, const char* name, TakeNumber number, TakeText text,
               void* context) {
  return attempt(file, [&] {
    const Handle access(within_file(H5P_LINK_ACCESS));
    if (checked(H5Aexists_by_name(file->id, path, name, access.id())) == 0) return;
    const Handle found(checked(H5Aopen_by_name(file->id, path, name, H5P_DEFAULT, access.id())));
    const Handle type(checked(H5Aget_type(found.id()))), space(checked(H5Aget_space(found.id())));
    constexpr hssize_t most = 4096;
    const hssize_t count = checked(H5Sget_simple_extent_npoints(space.id()));
    if (count > most) throw Failure{"its attribute has too many values"};
    const Source source{
        type.id(), static_cast<std::size_t>(count),
        [&](hid_t as, void* to) { return H5Aread(found.id(), as, to); },
        [&](hid_t as, void* texts) { H5Dvlen_reclaim(as, space.id(), H5P_DEFAULT, texts); }};
    const Kind kind = kind_of(type.id());
    if (kind == Kind::texts) return hdf5_module::read_texts(source, text, context);
    if (kind == Kind::other) return;
    std::vector<double> numbers(source.count);
    read_numbers(source, numbers.data());
    for (const double one : numbers) number(context, one);
  });
}

bool names(File* file, const char* path, TakeName take, void* context) {
  return attempt(file, [&] {
    const Handle type(checked(H5Dget_type(dataset_of(*file, path).id)));
    const int count = H5Tget_class(type.id()) == H5T_ENUM ? H5Tget_nmembers(type.id()) : 0;
    const Handle native(checked(H5Tget_native_type(type.id(), H5T_DIR_ASCEND)));
    for (int i = 0; i < count; ++i) {
      const auto index = static_cast<unsigned>(i);
      const auto value = [&](hid_t, void* to) {
        return H5Tget_member_value(native.id(), index, to);
      };
      double code = 0;
      read_codes({type.id(), 1, value, {}}, &code);
      char* const name = H5Tget_member_name(type.id(), index);
      if (name == nullptr) throw failure();
      take(context, code, name);
      H5free_memory(name);
    }
  });
}

/// A part of a dataset that may be read.
template <class Use>
bool use_part(File* file, const char* path, const std::uint64_t* start, const std::uint64_t* count,
              const Use& use) {
  return attempt(file, [&] {
    const Dataset& dataset = dataset_of(*file, path);
    const Handle type(checked(H5Dget_type(dataset.id)));
    const Part part = part_of(dataset, start, count);
    if (part.count == 0) return;
    use(Source{
        type.id(), part.count,
        [&](hid_t as, void* to) {
          return H5Dread(dataset.id, as, part.memory.id(), part.space.id(), H5P_DEFAULT, to);
        },
        [&](hid_t as, void* texts) { H5Dvlen_reclaim(as, part.memory.id(), H5P_DEFAULT, texts); }});
  });
}

bool read(File* file, const char* path, const std::uint64_t* start, const std::uint64_t* count,
          double* to) {
  return use_part(file, path, start, count,
                  [&](const Source& source) { read_numbers(source, to); });
}

bool read_texts(File* file, const char* path, const std::uint64_t* start,
                const std::uint64_t* count, TakeText take, void* context) {
  return use_part(file, path, start, count,
                  [&](const Source& source) { hdf5_module::read_texts(source, take, context); });
}

constexpr Table table = {version, library,   open,  close, error,     list,
                         look,    attribute, names, read,  read_texts};

/// What the loader looks for in the file before it runs any of the module.
[[gnu::used]] constexpr auto mark = std::to_array(version_mark);

}  // namespace
}  // namespace boule::hdf5_module

extern "C" [[gnu::visibility("default")]] const boule::hdf5_module::Table* boule_hdf5_module() {
  return &boule::hdf5_module::table;
}
