#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace tanglebin {

/// SHA-256 (FIPS 180-4) of bytes added piece by piece.
class Sha256 {
public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&& other) noexcept;
  Sha256& operator=(Sha256&& other) noexcept;

  void add(std::string_view bytes);

  /// The hash of all bytes so far, as 64 lower-case hexadecimal digits.
  std::string hex() const;

private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace tanglebin
