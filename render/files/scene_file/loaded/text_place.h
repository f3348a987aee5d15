#pragma once

namespace boule {

/// A place in a file's text; lines and columns count from 1, 0 means "nowhere".
struct TextPlace {
  int line = 0;
  int column = 0;
};

}  // namespace boule
