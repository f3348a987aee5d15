#include "render/files/packed/pack_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "simd/geometry/build_box.h"

namespace boule {

using packed_format::Header;
using packed_format::next_page;
using packed_format::page;

namespace {

std::string_view bytes_of(const void* bytes, std::size_t count) {
  return {static_cast<const char*>(bytes), count};
}

Diagnostic too_sparse() {
  return Diagnostic::of("its leaves have more slots than a chunk of a packed scene can have");
}

}  // namespace

PackWriter::PackWriter(OutputFile output, SpillFile ids, SpillFile materials, SpillFile nodes)
    : output_(std::move(output)),
      ids_(std::move(ids)),
      materials_(std::move(materials)),
      nodes_(std::move(nodes)) {}

Result<PackWriter> PackWriter::create(const std::string& output,
                                      const std::function<bool()>& stop) {
  auto file = OutputFile::create(output, stop);
  if (!file) return file.error();
  auto ids = SpillFile::create(output), materials = SpillFile::create(output);
  auto nodes = SpillFile::create(output);
  for (const auto* spill : {&ids, &materials, &nodes}) {
    if (!*spill) return spill->error();
  }
  PackWriter writer(std::move(file).value(), std::move(ids).value(), std::move(materials).value(),
                    std::move(nodes).value());
  const std::string header(page, '\0');  // in its place at the end
  if (auto done = writer.write(header.data(), header.size()); !done) return done.error();
  return Result<PackWriter>(std::move(writer));
}

Status PackWriter::write(const void* bytes, std::size_t count) {
  if (auto done = output_.write(bytes, count); !done) return done;
  size_ += count;
  if (checksum_) checksum_->add(bytes_of(bytes, count));
  return {};
}

Status PackWriter::begin_section(Kind kind) {
  const std::string gap(static_cast<std::size_t>(next_page(size_) - size_), '\0');
  if (auto done = write(gap.data(), gap.size()); !done) return done;
  sections_.push_back({kind, chunk_, size_, 0, 0});
  checksum_ = std::make_unique<PieceChecksum>();
  return {};
}

void PackWriter::end_section() {
  sections_.back().bytes = size_ - sections_.back().offset;
  sections_.back().checksum = checksum_->value();
  checksum_.reset();
}

Status PackWriter::begin_chunk(bool alike) {
  if (sections_.size() + 5 > packed_format::most_sections)
    return Diagnostic::of("a packed scene has at most 31 chunks of spheres");
  alike_ = alike;
  blocks_ = scanned_blocks_ = 0;
  return begin_section(Kind::blocks);
}

Result<std::uint32_t> PackWriter::append(const Bvh& tree, std::span<const std::uint32_t> ids) {
  if (tree.nodes.empty()) scanned_blocks_ += tree.blocks.size();
  const auto first_leaf = static_cast<std::uint32_t>(blocks_ - scanned_blocks_);
  blocks_ += tree.blocks.size();
  if (blocks_ * bvh_leaf_size > packed_format::most_slots) return too_sparse();
  if (auto done = write(tree.blocks.data(), tree.blocks.size() * sizeof(SphereBlock)); !done)
    return done.error();
  std::vector<std::int32_t> slots(tree.slots.begin(), tree.slots.end());
  for (std::int32_t& slot : slots) {
    if (slot >= 0) slot = static_cast<std::int32_t>(ids[static_cast<std::size_t>(slot)]);
  }
  if (auto done = ids_.append(slots.data(), slots.size() * sizeof(std::int32_t)); !done)
    return done.error();
  if (!alike_) {
    std::vector<MaterialRef> materials(slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (slots[i] >= 0) materials[i] = tree.materials[static_cast<std::uint32_t>(i)];
    }
    if (auto done = materials_.append(materials.data(), materials.size() * sizeof(MaterialRef));
        !done)
      return done.error();
  }
  const auto first = static_cast<std::uint32_t>(nodes_.size() / sizeof(BvhNode));
  if (auto done = append_nodes(tree, first_leaf); !done) return done.error();
  return first;
}

Status PackWriter::append_nodes(const Bvh& tree, std::uint32_t first_leaf) {
  const auto first = static_cast<std::uint32_t>(nodes_.size() / sizeof(BvhNode));
  constexpr std::size_t at_once = 8192;
  std::vector<BvhNode> some;
  for (std::size_t begin = 0; begin < tree.nodes.size(); begin += at_once) {
    const std::size_t end = std::min(begin + at_once, tree.nodes.size());
    some.assign(tree.nodes.begin() + begin, tree.nodes.begin() + end);
    for (BvhNode& node : some) {
      for (std::size_t k = 0; k < node.size; ++k)
        node.child[k] += node.leaf_size[k] > 0 ? first_leaf : first;
    }
    if (auto done = nodes_.append(some.data(), some.size() * sizeof(BvhNode)); !done) return done;
  }
  return {};
}

Result<std::uint32_t> PackWriter::reserve_nodes(std::size_t count) {
  const auto first = static_cast<std::uint32_t>(nodes_.size() / sizeof(BvhNode));
  const std::vector<BvhNode> room(count);
  if (auto done = nodes_.append(room.data(), count * sizeof(BvhNode)); !done) return done.error();
  return first;
}

Status PackWriter::set_node(std::uint32_t index, const BvhNode& node) {
  return nodes_.write(std::uint64_t{index} * sizeof node, &node, sizeof node);
}

Status PackWriter::append_spilled(Kind kind, SpillFile& spill) {
  if (auto done = begin_section(kind); !done) return done;
  std::string buffer;
  constexpr std::uint64_t at_once = std::uint64_t{4} << 20;
  for (std::uint64_t done = 0; done < spill.size(); done += buffer.size()) {
    buffer.resize(static_cast<std::size_t>(std::min(at_once, spill.size() - done)));
    if (auto read = spill.read(done, buffer.data(), buffer.size()); !read) return read;
    if (auto written = write(buffer.data(), buffer.size()); !written) return written;
    spill.forget(done, buffer.size());
  }
  end_section();
  return spill.clear();
}

Status PackWriter::end_chunk() {
  end_section();
  if (auto done = append_spilled(Kind::ids, ids_); !done) return done;
  if (!alike_) {
    if (auto done = append_spilled(Kind::materials, materials_); !done) return done;
  }
  if (auto done = append_spilled(Kind::nodes, nodes_); !done) return done;
  ++chunk_;
  return {};
}

Result<std::uint64_t> PackWriter::finish(const PackedContents& contents,
                                         const std::function<bool()>& stop) {
  chunk_ = 0;
  if (auto done = begin_section(Kind::contents); !done) return done.error();
  const std::string bytes = encode(contents);
  if (auto done = write(bytes.data(), bytes.size()); !done) return done.error();
  end_section();
  Header header{};
  std::copy_n(packed_format::magic, sizeof header.magic, header.magic);
  header.version = packed_format::version;
  header.sections = static_cast<std::uint32_t>(sections_.size());
  header.file_bytes = size_;
  std::copy(sections_.begin(), sections_.end(), header.section);
  header.checksum = PieceChecksum::of_piece(bytes_of(&header, sizeof header));
  const ssize_t written = ::pwrite(output_.descriptor(), &header, sizeof header, 0);
  if (written != ssize_t{sizeof header})
    return cannot_write(output_.path(), written < 0 ? errno : EIO);
  if (auto done = output_.commit(stop); !done) return done.error();
  return size_;
}

}  // namespace boule
