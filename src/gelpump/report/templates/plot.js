// Drawing on a canvas in the page's colours, sharp on any screen.
const SERIF = '"STIX Two Text", "Times New Roman", Times, serif';

class Canvas {
  constructor(element, draw) {
    this.element = element;
    this.context = element.getContext("2d");
    this.draw = draw;
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.width = this.element.clientWidth;
    this.height = this.element.clientHeight;
    this.element.width = Math.round(this.width * ratio);
    this.element.height = Math.round(this.height * ratio);
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.paint();
  }

  paint() {
    if (!this.width) return;
    this.context.clearRect(0, 0, this.width, this.height);
    this.draw(this.context, this.width, this.height);
  }
}

const linear = (from, to) => Object.assign((value, low, high) => low + ((value - from) / (to - from)) * (high - low), { from, to });
const logarithmic = (from, to) => {
  const [start, end] = [Math.log(from), Math.log(to)];
  return Object.assign((value, low, high) => low + ((Math.log(value) - start) / (end - start)) * (high - low), { from, to, log: true });
};

function ticks(scale, count) {
  const marks = [];
  if (scale.log) {
    for (let power = Math.ceil(Math.log10(scale.from) - 1e-9); 10 ** power <= scale.to * (1 + 1e-9); power++) marks.push(10 ** power);
    const step = Math.ceil(marks.length / (count + 1));
    return marks.filter((_, i) => i % step === 0);
  }
  const raw = (scale.to - scale.from) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((each) => each >= raw * 0.999);
  for (let i = Math.ceil(scale.from / step - 1e-9); i * step <= scale.to + 1e-9 * step; i++) marks.push(i * step);
  return marks;
}

const tickText = (value, log) => (log && (value < 1e-2 || value > 1e3) ? printed(value).replace(/^1×/, "") : printed(Number(value.toPrecision(6)), 6));

// A frame with axes; gives x(value), y(value) in pixels.
function axes(context, width, height, { x, y, xLabel, yLabel, left = 52, bottom = 40, top = 12, right = 12 }) {
  const box = { left, right: width - right, top, bottom: height - bottom };
  const at = { x: (value) => x(value, box.left, box.right), y: (value) => y(value, box.bottom, box.top), box };
  context.lineWidth = 1;
  context.strokeStyle = themed("soft");
  context.strokeRect(box.left + 0.5, box.top + 0.5, box.right - box.left, box.bottom - box.top);
  context.fillStyle = themed("soft");
  context.font = `13px ${SERIF}`;
  context.textAlign = "center";
  context.textBaseline = "top";
  context.beginPath();
  for (const mark of ticks(x, Math.max(2, Math.round(width / 95)))) {
    const place = Math.round(at.x(mark)) + 0.5;
    context.moveTo(place, box.bottom);
    context.lineTo(place, box.bottom - 4);
    context.fillText(tickText(mark, x.log), place, box.bottom + 5);
  }
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const mark of ticks(y, Math.max(2, Math.round(height / 60)))) {
    const place = Math.round(at.y(mark)) + 0.5;
    context.moveTo(box.left, place);
    context.lineTo(box.left + 4, place);
    context.fillText(tickText(mark, y.log), box.left - 6, place);
  }
  context.stroke();
  context.fillStyle = themed("ink");
  context.font = `italic 14px ${SERIF}`;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  lettered(context, xLabel, (box.left + box.right) / 2, height - 3);
  context.save();
  context.translate(13, (box.top + box.bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textBaseline = "middle";
  lettered(context, yLabel, 0, 0);
  context.restore();
  return at;
}

// A centred label whose subscripts, as in R_{dry}, are lowered.
function lettered(context, text, x, y) {
  const font = context.font;
  const small = font.replace(/\d+px/, "10px");
  const pieces = text.split(/_\{(.*?)\}/).map((piece, i) => {
    context.font = i % 2 ? small : font;
    return { piece, lowered: i % 2, width: context.measureText(piece).width };
  });
  let at = x - pieces.reduce((sum, each) => sum + each.width, 0) / 2;
  const align = context.textAlign;
  context.textAlign = "left";
  for (const { piece, lowered, width } of pieces) {
    context.font = lowered ? small : font;
    context.fillText(piece, at, y + (lowered ? 4 : 0));
    at += width;
  }
  context.font = font;
  context.textAlign = align;
}

function clipped(context, { left, right, top, bottom }, draw) {
  context.save();
  context.beginPath();
  context.rect(left, top, right - left, bottom - top);
  context.clip();
  draw();
  context.restore();
}

function line(context, at, xs, ys, { colour, width = 1.6, dash = [] }) {
  context.beginPath();
  let open = false;
  for (let i = 0; i < xs.length; i++) {
    if (Number.isNaN(ys[i]) || Number.isNaN(xs[i])) open = false;
    else if (open) context.lineTo(at.x(xs[i]), at.y(ys[i]));
    else {
      context.moveTo(at.x(xs[i]), at.y(ys[i]));
      open = true;
    }
  }
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineJoin = "round";
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

function dot(context, x, y, { colour, fill = colour, size = 4, square = false }) {
  context.beginPath();
  if (square) context.rect(x - size, y - size, 2 * size, 2 * size);
  else context.arc(x, y, size, 0, 2 * Math.PI);
  context.fillStyle = fill;
  context.fill();
  context.strokeStyle = colour;
  context.lineWidth = 1.6;
  context.stroke();
}

function arrow(context, x, y, dx, dy, { colour, edge, width = 1.6 }) {
  const length = Math.hypot(dx, dy);
  const head = Math.min(7, 0.6 * length);
  const [ux, uy] = [dx / length, dy / length];
  const shaft = [x + dx - head * ux, y + dy - head * uy];
  for (const [stroke, thickness] of [[edge, width + 2], [colour, width]]) {
    if (!stroke) continue;
    const spread = head * 0.5 + (thickness - width) * 0.6;
    context.strokeStyle = context.fillStyle = stroke;
    context.lineWidth = thickness;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(...shaft);
    context.stroke();
    context.beginPath();
    context.moveTo(x + dx + (thickness - width) * 0.8 * ux, y + dy + (thickness - width) * 0.8 * uy);
    context.lineTo(shaft[0] - spread * uy, shaft[1] + spread * ux);
    context.lineTo(shaft[0] + spread * uy, shaft[1] - spread * ux);
    context.fill();
  }
}

function words(context, text, x, y, { colour, align = "left", base = "middle", size = 13 }) {
  context.font = `${size}px ${SERIF}`;
  context.fillStyle = colour;
  context.textAlign = align;
  context.textBaseline = base;
  context.fillText(text, x, y);
}

// Colour of a share between 0 and 1 of the figures' map of polymer fractions.
const shade = (share) => {
  const map = data.colours.polymer;
  return map[Math.max(0, Math.min(map.length - 1, Math.round(share * (map.length - 1))))];
};

// A bar of that map, from one polymer fraction to another.
function shadeBar(context, x, y, width, low, high, label) {
  for (let i = 0; i < width; i++) {
    context.fillStyle = shade(i / (width - 1));
    context.fillRect(x + i, y, 1.5, 8);
  }
  context.strokeStyle = themed("soft");
  context.lineWidth = 0.7;
  context.strokeRect(x, y, width, 8);
  words(context, low, x - 5, y + 4, { colour: themed("soft"), align: "right" });
  words(context, `${high}   ${label}`, x + width + 5, y + 4, { colour: themed("soft") });
}
