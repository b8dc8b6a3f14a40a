#include "tanglebin/dataset/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <iterator>
#include <stdexcept>

namespace tanglebin {
namespace {

void expect_success(int result) {
  if (result != 1) throw std::runtime_error("OpenSSL cannot compute SHA-256");
}

}  // namespace

struct Sha256::Context {
  Context() : openssl(EVP_MD_CTX_new()) { expect_success(openssl == nullptr ? 0 : 1); }
  ~Context() { EVP_MD_CTX_free(openssl); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  EVP_MD_CTX* openssl;
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  expect_success(EVP_DigestInit_ex(context_->openssl, EVP_sha256(), nullptr));
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::string_view bytes) {
  expect_success(EVP_DigestUpdate(context_->openssl, bytes.data(), bytes.size()));
}

std::string Sha256::hex() const {
  const Context copy;  // that the original may go on
  expect_success(EVP_MD_CTX_copy_ex(copy.openssl, context_->openssl));
  std::array<unsigned char, 32> digest{};
  expect_success(EVP_DigestFinal_ex(copy.openssl, digest.data(), nullptr));
  std::string text;
  for (const unsigned char byte : digest) fmt::format_to(std::back_inserter(text), "{:02x}", byte);
  return text;
}

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

}  // namespace tanglebin
