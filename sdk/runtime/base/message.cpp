#include "runtime/base/message.h"

namespace sphc {

constexpr double kLeastPlain = 1e-4;  // smaller ones have an exponent

void MessageWriter::put(char c) {
  if (!target_ || length_ + 1 >= SPHC_MESSAGE_BYTES) return;
  target_->text[length_++] = c;
  target_->text[length_] = '\0';
}

MessageWriter &MessageWriter::operator<<(const char *text) {
  for (; *text; ++text) put(*text);
  return *this;
}

MessageWriter &MessageWriter::writeUnsigned(uint64_t value) {
  char digits[20];
  int n = 0;
  do {
    digits[n++] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value);
  while (n) put(digits[--n]);
  return *this;
}

MessageWriter &MessageWriter::writeSigned(int64_t value) {
  if (value < 0) {
    put('-');
    return writeUnsigned(~static_cast<uint64_t>(value) + 1);  // -INT64_MIN has no int64
  }
  return writeUnsigned(static_cast<uint64_t>(value));
}

MessageWriter &MessageWriter::operator<<(double value) {
  if (value != value) return *this << "nan";
  if (value < 0) {
    put('-');
    value = -value;
  }
  if (value > 1e18) return *this << (value > 1.7e308 ? "inf" : "1e18+");
  int exponent = 0;
  if (value > 0 && value < kLeastPlain)
    for (; value < 1; value *= 10) --exponent;
  int decimals = 6;
  for (double v = value; v >= 1 && decimals > 0; v /= 10) --decimals;
  double scale = 1;
  for (int i = 0; i < decimals; ++i) scale *= 10;
  double rounded = value * scale + 0.5;
  uint64_t whole = static_cast<uint64_t>(rounded / scale);
  uint64_t fraction = static_cast<uint64_t>(rounded - static_cast<double>(whole) * scale);
  *this << whole;
  char digits[8];
  for (int i = decimals; i-- > 0; fraction /= 10) digits[i] = static_cast<char>('0' + fraction % 10);
  while (decimals && digits[decimals - 1] == '0') --decimals;
  if (decimals) put('.');
  for (int i = 0; i < decimals; ++i) put(digits[i]);
  if (exponent) *this << "e" << exponent;
  return *this;
}

}  // namespace sphc
