#include "collab/link/certificate.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>

#include "io/file_bytes.h"
#include "io/open_file.h"

namespace icome::collab {
namespace {

constexpr long kCertificateAge = 3600;                       // s, for clients whose clock is slow
constexpr long kCertificateLife = 10L * 366L * 24L * 3600L;  // s
constexpr std::uint64_t kMostOfCertificate = 1U << 20U;      // bytes

template <auto Free>
struct FreeBy {
  template <typename T>
  void operator()(T* thing) const {
    Free(thing);
  }
};
using KeyOfCertificate = std::unique_ptr<EVP_PKEY, FreeBy<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, FreeBy<X509_free>>;
using MemoryOfPem = std::unique_ptr<BIO, FreeBy<BIO_free_all>>;

bool add_extension(X509* certificate, int kind, const char* value) {
  using Extension = std::unique_ptr<X509_EXTENSION, FreeBy<X509_EXTENSION_free>>;
  const Extension extension(X509V3_EXT_conf_nid(nullptr, nullptr, kind, value));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

bool set_serial(X509* certificate) {
  std::array<unsigned char, 16> bytes = {};
  if (RAND_bytes(bytes.data(), int(bytes.size())) != 1) return false;
  bytes[0] = static_cast<unsigned char>((bytes[0] & 0x7FU) | 0x40U);  // positive, and all digits count
  using Number = std::unique_ptr<BIGNUM, FreeBy<BN_free>>;
  const Number number(BN_bin2bn(bytes.data(), int(bytes.size()), nullptr));
  return number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

/// Null on failure, which is want of memory or of random numbers.
Certificate self_signed(EVP_PKEY* key) {
  Certificate made(X509_new());
  if (!made || X509_set_version(made.get(), X509_VERSION_3) != 1 || !set_serial(made.get())) return nullptr;
  X509_gmtime_adj(X509_getm_notBefore(made.get()), -kCertificateAge);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), kCertificateLife);
  X509_NAME* const name = X509_get_subject_name(made.get());
  const auto* const host = reinterpret_cast<const unsigned char*>("localhost");
  const bool is_whole =
      X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, host, -1, -1, 0) == 1 &&
      X509_set_issuer_name(made.get(), name) == 1 && X509_set_pubkey(made.get(), key) == 1 &&
      add_extension(made.get(), NID_basic_constraints, "critical,CA:FALSE") &&
      add_extension(made.get(), NID_key_usage, "critical,digitalSignature") &&
      add_extension(made.get(), NID_ext_key_usage, "serverAuth") &&
      add_extension(made.get(), NID_subject_alt_name, "DNS:localhost,IP:127.0.0.1,IP:::1") &&
      X509_sign(made.get(), key, EVP_sha256()) != 0;
  return is_whole ? std::move(made) : nullptr;
}

template <typename Write>
std::string pem_of(const Write& write) {
  const MemoryOfPem memory(BIO_new(BIO_s_mem()));
  if (!memory || write(memory.get()) != 1) return {};
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(memory.get(), &bytes);
  return {bytes, std::size_t(size)};
}

base::Result<void> cannot_make(const std::filesystem::path& path, const char* why) {
  return base::fail(fmt::format("{}: cannot be written ({}).", path.string(), why));
}

/// Writes a file that must not be there yet. Unlike io::NewFile, which is for files that everybody may read,
/// it has its permissions from the first, and never takes the place of another.
base::Result<void> write_new(const std::filesystem::path& path, std::string_view bytes, unsigned mode) {
  const std::string beside = fmt::format("{}.new-{}", path.string(), ::getpid());
  ::unlink(beside.c_str());
  const int file = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) return cannot_make(path, std::strerror(errno));
  const ssize_t count = ::write(file, bytes.data(), bytes.size());
  int error = count == ssize_t(bytes.size()) ? 0 : (count < 0 ? errno : ENOSPC);
  if (error == 0 && ::fsync(file) != 0) error = errno;
  ::close(file);
  if (error == 0 && ::link(beside.c_str(), path.c_str()) != 0) error = errno;
  ::unlink(beside.c_str());
  if (error == EEXIST)
    return base::fail(fmt::format("{}: is there already; remove it or choose another.", path.string()));
  if (error != 0) return cannot_make(path, std::strerror(error));
  io::sync_folder_of(path);
  return {};
}

}  // namespace

base::Result<void> make_certificate(const std::filesystem::path& certificate,
                                    const std::filesystem::path& key) {
  const KeyOfCertificate pair(EVP_EC_gen("P-256"));
  const Certificate made = pair ? self_signed(pair.get()) : nullptr;
  if (!made) return base::fail("A certificate cannot be made: memory or random numbers are wanting.");
  const std::string public_part = pem_of([&](BIO* to) { return PEM_write_bio_X509(to, made.get()); });
  std::string secret_part = pem_of([&](BIO* to) {
    return PEM_write_bio_PrivateKey(to, pair.get(), nullptr, nullptr, 0, nullptr, nullptr);
  });
  if (public_part.empty() || secret_part.empty()) return base::fail("A certificate cannot be made.");
  base::Result<void> written = write_new(key, secret_part, 0600);
  OPENSSL_cleanse(secret_part.data(), secret_part.size());
  if (!written) return written;
  written = write_new(certificate, public_part, 0644);
  if (!written) ::unlink(key.c_str());  // a key without its certificate would be in the way of the next try
  return written;
}

base::Result<std::string> fingerprint_of(const std::filesystem::path& certificate) {
  const base::Result<std::string> bytes = io::read_bytes(certificate, kMostOfCertificate);
  if (!bytes) return tl::unexpected(bytes.error());
  const MemoryOfPem memory(BIO_new_mem_buf(bytes->data(), int(bytes->size())));
  const Certificate read(memory ? PEM_read_bio_X509(memory.get(), nullptr, nullptr, nullptr) : nullptr);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest = {};
  unsigned size = 0;
  if (!read || X509_digest(read.get(), EVP_sha256(), digest.data(), &size) != 1)
    return base::fail(fmt::format("{}: holds no certificate in PEM.", certificate.string()));
  std::string text = "sha256:";
  for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace icome::collab
