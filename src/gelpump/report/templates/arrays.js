// Arrays as `gelpump.report.embedded` packs them, and numbers as they are printed.
function bytes(text) {
  const decoded = atob(text);
  const result = new Uint8Array(decoded.length);
  for (let i = 0; i < decoded.length; i++) result[i] = decoded.charCodeAt(i);
  return result.buffer;
}

function unpack(packed) {
  if (packed.float32 !== undefined) return new Float32Array(bytes(packed.float32));
  const steps = new Uint16Array(bytes(packed.uint16));
  const low = unpack(packed.low);
  const span = unpack(packed.span);
  const length = steps.length / low.length;
  const values = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; i++) {
    const row = Math.floor(i / length);
    values[i] = low[row] + (span[row] * steps[i]) / 65535;
  }
  return values;
}

const row = (values, shape, index) => {
  const length = shape[shape.length - 1];
  return values.subarray(index * length, (index + 1) * length);
};

const SUPERSCRIPT = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

// Four significant digits, or as many as told.
function printed(value, digits = 4) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const sign = value < 0 ? "−" : "";
  if (size >= 1e-3 && size < 1e5) return sign + Number(size.toPrecision(digits)).toString();
  const [mantissa, exponent] = size.toExponential(digits - 1).split("e");
  const power = [...String(Number(exponent))].map((sign) => SUPERSCRIPT[sign]).join("");
  return `${sign}${Number(mantissa)}×10${power}`;
}

// Where a value would stand in an ascending list.
function place(list, value) {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

const largest = (values) => values.reduce((most, value) => Math.max(most, value), -Infinity);
const smallest = (values) => values.reduce((least, value) => Math.min(least, value), Infinity);
