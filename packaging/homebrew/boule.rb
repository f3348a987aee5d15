# brew install --HEAD packaging/homebrew/boule.rb, from a clone: builds its main branch, on Linux.
# There is no Homebrew in Debian: the tests ask Ruby whether it can be read, and it was never built by brew.
class Boule < Formula
  desc "Ray tracer for spheres, planes and capsules with exact hits"
  license "MIT"
  head "file://#{Pathname(__dir__).parent.parent}", using: :git, branch: "main"

  depends_on "boost" => :build
  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "fast_float" => :build
  depends_on "lowdown" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "tomlplusplus" => :build
  depends_on "xsimd" => :build
  depends_on "bzip2"
  depends_on "fmt"
  depends_on "hdf5"
  depends_on "jpeg-turbo"
  depends_on "libpng"
  depends_on "libzip"
  depends_on :linux
  depends_on "openimageio"
  depends_on "pango"
  depends_on "xxhash"
  depends_on "xz"
  depends_on "zlib"
  depends_on "zstd"

  def install
    system "cmake", "--preset", "release", "-G", "Ninja", "-B", "build/brew", "-DBOULE_TESTS=OFF", *std_cmake_args
    system "cmake", "--build", "build/brew"
    system "cmake", "--install", "build/brew"
  end

  test do
    system bin/"boule", "render", pkgshare/"scenes/first_light.toml", "-o", "first_light.png", "--size", "64x36"
    assert_path_exists testpath/"first_light.png"
  end
end
