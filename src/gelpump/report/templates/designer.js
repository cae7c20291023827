// Design your own: inputs in the form, numbers and lights of `device.js`, a picture, and exports.
const UNITS = {
  s: [[86400, "d"], [3600, "h"], [60, "min"], [1, "s"], [1e-3, "ms"], [1e-6, "µs"]],
  m: [[1, "m"], [1e-3, "mm"], [1e-6, "µm"], [1e-9, "nm"]], "m/s": [[1, "m/s"], [1e-3, "mm/s"], [1e-6, "µm/s"], [1e-9, "nm/s"]],
  "m^3": [[1e-6, "mL"], [1e-9, "µL"], [1e-12, "nL"], [1e-15, "pL"], [1e-18, "fL"]],
  "m^3/s": [[1e-6, "mL/s"], [1e-9, "µL/s"], [1e-12, "nL/s"], [1e-15, "pL/s"], [1e-18, "fL/s"]],
  Pa: [[1e9, "GPa"], [1e6, "MPa"], [1e3, "kPa"], [1, "Pa"], [1e-3, "mPa"]],
};
const PLAIN_UNITS = { 1: "", "m^2/s": "m²/s", "m/s^0.5": "m/√s" };
const LIGHT_MARKS = { green: "●", amber: "▲", red: "■" };
const OWN_GEL = ["osmotic_modulus", "osmotic_modulus_hot", "shear_modulus", "polymer_fraction", "polymer_fraction_hot"];

// A number with its unit, in the first unit in which it is at least one.
function withUnit(value, unit, digits = 4) {
  const choices = UNITS[unit];
  if (!choices) return `${printed(value, digits)} ${PLAIN_UNITS[unit] ?? unit}`.trim();
  const [size, name] = choices.find(([each]) => Math.abs(value) >= 0.9995 * each) ?? choices[choices.length - 1];
  return `${printed(value / size, digits)} ${name}`;
}

class Designer extends Explorer {
  constructor() {
    super("designer");
    this.fields = new Map();
    for (const row of this.element.querySelectorAll("[data-field]")) this.addField(row);
    const [first] = Object.values(data.design.designs);
    this.start = first;
    for (const name of ["gel", "title", "light", "surrounding"]) this.control(name).addEventListener("input", () => this.changed());
    this.control("preset").addEventListener("change", (event) => this.take(data.design.designs[event.target.value]));
    this.setTime = this.slider("moment", 101, 100, () => this.momentText(), (i) => {
      this.moment = i;
      this.setTime(i);
      this.paint();
    });
    this.moment = 100;
    this.control("near").addEventListener("change", () => this.paint());
    for (const name of ["yaml", "csv", "copy"]) this.element.querySelector(`[data-do="${name}"]`).addEventListener("click", () => this[name]());
    this.canvas("wave", (...all) => this.drawTube(...all));
    this.canvas("plane", (...all) => this.drawPlane(...all));
    this.canvas("pareto", (...all) => this.drawPareto(...all));
    const shared = location.hash.match(/^#design\?(.*)/);
    this.fill(first);
    if (shared) {
      this.restore(new URLSearchParams(shared[1]));
      document.getElementById("design").scrollIntoView();
    }
    this.changed(false);
  }

  // A number field with a logarithmic slider beside it; both hold the number in the unit shown.
  addField(row) {
    const { field: key, factor, low, high, linear: evenly } = row.dataset;
    const [number, slider] = [row.querySelector('[type="number"]'), row.querySelector('[type="range"]')];
    const [from, to] = [Number(low), Number(high)];
    const toSlider = () => {
      const value = Number(number.value);
      if (!slider || !(value > 0)) return;
      slider.value = evenly ? ((value - from) / (to - from)) * 1000 : (Math.log(value / from) / Math.log(to / from)) * 1000;
      slider.setAttribute("aria-valuetext", `${number.value} ${row.dataset.unit}`);
    };
    number.addEventListener("input", () => {
      toSlider();
      this.changed();
    });
    slider?.addEventListener("input", () => {
      const share = slider.value / 1000;
      number.value = Number((evenly ? from + share * (to - from) : from * (to / from) ** share).toPrecision(3));
      slider.setAttribute("aria-valuetext", `${number.value} ${row.dataset.unit}`);
      this.changed();
    });
    this.fields.set(key, { row, number, toSlider, factor: Number(factor), unit: row.dataset.unit });
  }

  set(key, value) {
    const { number, toSlider, factor } = this.fields.get(key);
    number.value = Number((value / factor).toPrecision(12));
    toSlider();
  }

  // Fill the form with a design in SI units.
  fill(design) {
    for (const [key, value] of Object.entries(design)) if (this.fields.has(key)) this.set(key, value);
    if (design.gel) {
      this.control("gel").value = design.gel;
      this.control("surrounding").value = design.surrounding;
      if (!design.enthalpy) this.fields.get("enthalpy").number.value = "";
    }
    if (design.title) this.control("title").value = design.title;
  }

  take(design) {
    this.fill(design);
    this.changed();
  }

  restore(shared) {
    for (const [key, value] of shared) {
      if (this.fields.has(key) && Number(value) > 0) {
        this.fields.get(key).number.value = value;
        this.fields.get(key).toSlider();
      } else if (key === "gel" && (value === "own" || value in data.design.gels)) this.control("gel").value = value;
      else if (key === "surrounding") this.control("surrounding").value = value;
      else if (key === "enthalpy") this.fields.get("enthalpy").number.value = "";
      else if (key === "title") this.control("title").value = value.slice(0, 80);
    }
  }

  // Which fields the chosen gel asks for.
  asked(key) {
    if (key === "pipe_section") return this.control("surrounding").value === "pipe";
    const gel = this.control("gel").value;
    if (!OWN_GEL.includes(key)) return true;
    return gel === "own" || (key === "osmotic_modulus" && data.design.gels[gel].kind === "ratios");
  }

  given() {
    const given = { gel: this.control("gel").value, surrounding: this.control("surrounding").value };
    for (const key of ["molecule_volume", "repeat_unit", "polymer_density", "heat_capacity"]) given[key] = this.start[key];
    for (const [key, { number, factor }] of this.fields) {
      if (key === "enthalpy" && number.value === "") continue;
      if (this.asked(key) && !key.startsWith("wanted_")) given[key] = number.value === "" ? NaN : Number(number.value) * factor;
    }
    return given;
  }

  changed(byReader = true) {
    for (const [key, { row }] of this.fields) row.hidden = !this.asked(key);
    const started = performance.now();
    try {
      this.device = evaluate(this.given());
      this.refusal = "";
    } catch (refusal) {
      if (!(refusal instanceof Refusal)) throw refusal;
      this.device = undefined;
      this.refusal = `Refused: ${refusal.message}.`;
    }
    this.show();
    this.element.dataset.milliseconds = (performance.now() - started).toFixed(2);
    if (byReader) {
      clearTimeout(this.sharing);
      this.sharing = setTimeout(() => history.replaceState(null, "", this.fragment()), 300);
    }
    this.ask();
  }

  show() {
    const { device } = this;
    this.element.querySelector("[data-refusal]").textContent = this.refusal;
    this.element.querySelector("[data-results]").hidden = !device;
    clearTimeout(this.saying);
    this.saying = setTimeout(() => (this.element.querySelector("[data-said]").textContent = this.summary()), 400);
    if (device) {
      const { numbers } = device;
      const head = {
        response: "response_time", front: "travel_time", pumped: "final_pumped_volume_conserving", inPrint: "final_pumped_volume_printed", flow: "final_flow_far_conserving", width: "final_front_width",
      };
      for (const [name, key] of Object.entries(head)) this.number(name, numbers[key] ? this.said(key) : "not told");
      if (device.model.late) this.number("pumped", `${this.said("final_pumped_volume_conserving")}, ${this.direction()}`);
      this.element.querySelector("[data-lights]").replaceChildren(...device.lights.map((each) => this.lightRow(each)));
      this.element.querySelector("[data-table]").replaceChildren(...Object.keys(numbers).map((key) => this.numberRow(key)));
      this.element.querySelector("[data-late]").textContent = device.model.late
        ? ""
        : "The wall has not relaxed by the time the front has travelled the heated length: such a pulse is no wave, and its front, flow and volume need the sheet.";
      this.setTime(this.moment);
    }
    this.element.querySelector("[data-file]").textContent = this.refusal || this.yamlText();
    this.paint();
  }

  said(key) {
    const [value, error] = this.device.numbers[key];
    const told = withUnit(value, data.design.quantities[key][1]);
    return `${told} ${this.doubt(value, error)}`.trim();
  }

  // The share of a number that is uncertain, in words: all of it where no front was found.
  doubt(value, error) {
    const share = error && value ? (100 * error) / Math.abs(value) : 0;
    if (!Number.isFinite(share)) return "(unknown: no front was found)";
    return share >= 0.005 ? `± ${printed(share, 2)} %` : "";
  }

  direction() {
    return `${this.device.numbers.final_pumped_volume_conserving[0] > 0 ? "away from" : "towards"} the heated end`;
  }

  summary() {
    if (!this.device) return this.refusal;
    const { lights, model } = this.device;
    const count = (light) => lights.filter((each) => each.light === light).length;
    const pumped = model.late ? ` Pumps ${this.said("final_pumped_volume_conserving")} ${this.direction()}, per pulse and side.` : "";
    return `Responds in ${this.said("response_time")}.${pumped} Lights: ${count("green")} green, ${count("amber")} amber, ${count("red")} red.`;
  }

  lightRow({ key, value, light, open }) {
    const { text, symbol, green, amber, large } = data.design.criteria[key];
    const item = document.createElement("li");
    item.className = `light-${light}`;
    const sign = large ? "≥" : "≤";
    const limit = amber > 1e-9 ? printed(amber) : "0";
    item.innerHTML = `<strong><span aria-hidden="true">${LIGHT_MARKS[light]}</span> ${light}</strong> <span></span><small></small>`;
    item.children[1].textContent = text;
    item.children[2].textContent = `${symbol} = ${value < 1e9 ? printed(value, 3) : "unknown"}${open ? ", open" : ""}; green ${sign} ${printed(green)}, amber ${sign} ${limit}`;
    return item;
  }

  numberRow(key) {
    const [text, unit, source] = data.design.quantities[key];
    const [value, error] = this.device.numbers[key];
    const row = document.createElement("tr");
    const cells = [text, withUnit(value, unit), this.doubt(value, error), source];
    row.append(...cells.map((content, i) => {
      const cell = document.createElement(i ? "td" : "th");
      if (!i) cell.scope = "row";
      cell.textContent = content;
      return cell;
    }));
    return row;
  }

  fragment() {
    const shared = new URLSearchParams({ gel: this.control("gel").value, surrounding: this.control("surrounding").value, title: this.control("title").value });
    for (const [key, { number }] of this.fields) if (this.asked(key)) shared.set(key, number.value);
    return `#design?${shared}`;
  }

  yamlText() {
    const quantity = (key) => {
      const { number, unit } = this.fields.get(key);
      return `${Number(number.value)} ${unit}`.trim();
    };
    const gel = this.control("gel").value;
    const file = data.design.gels[gel]?.file;
    const lines = [`# made in the page of gelpump's report${file ? `; solve it with --configfile ${file}` : ""}`, `title: ${JSON.stringify(this.control("title").value.slice(0, 80) || "A tube")}`, "kind: tube"];
    for (const [key, { number }] of this.fields) {
      if (OWN_GEL.includes(key) || key.startsWith("wanted_") || !this.asked(key)) continue;
      lines.push(`${key}: ${key === "enthalpy" && number.value === "" ? "unknown" : quantity(key)}`);
    }
    lines.push(`surrounding: ${this.control("surrounding").value}`);
    if (gel !== "own") lines.push(`gel: ${gel}`);
    else lines.push("gel:", ...OWN_GEL.map((key) => `  ${key}: ${quantity(key)}`));
    if (gel !== "own" && data.design.gels[gel].kind === "ratios") lines.push(`osmotic_modulus: ${quantity("osmotic_modulus")}`);
    if (Number(this.fields.get("wanted_time").number.value) > 0) lines.push(`wanted: {response_time: ${quantity("wanted_time")}}`);
    return `${lines.join("\n")}\n`;
  }

  csvText() {
    const cell = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const rows = [["key", "meaning", "value", "unit", "uncertainty", "gel error", "source"]];
    const { numbers, lights } = this.device;
    for (const [key, [value, error]] of Object.entries(numbers)) {
      const [text, unit, source] = data.design.quantities[key];
      rows.push([key, text, String(Number(value.toPrecision(10))), unit, error ? error.toPrecision(3) : "", "", source]);
    }
    for (const { key, value, light } of lights) {
      const { text, symbol, green, amber, source } = data.design.criteria[key];
      rows.push([`light_${key}`, text, light, "", "", "", `${source}: ${symbol} = ${value}, limits ${green} and ${amber}`]);
    }
    return rows.map((row) => row.map(cell).join(",")).join("\n") + "\n";
  }

  save(text, ending, type) {
    const name = this.control("title").value.toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_+|_+$/g, "") || "design";
    const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(new Blob([text], { type })), download: `${name}.${ending}` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  yaml() {
    if (this.device) this.save(this.yamlText(), "yaml", "application/yaml");
  }

  csv() {
    if (this.device) this.save(this.csvText(), "csv", "text/csv");
  }

  copy() {
    const link = location.href.replace(/#.*/, "") + this.fragment();
    const shown = this.element.querySelector("[data-link]");
    shown.value = link;
    shown.hidden = false;
    shown.select();
    navigator.clipboard?.writeText(link).catch(() => {});
  }

  // The moment of the picture: tau from when the wall has relaxed once to the end.
  tau() {
    const { tube, tau_99, end } = this.device.model;
    const early = Math.min(conserving(tube, tau_99)[1], end);
    return early * (end / early) ** (this.moment / 100);
  }

  momentText() {
    if (!this.device?.model.late) return "";
    return withUnit(this.tau() * this.device.model.t_pore, "s", 3);
  }

  play() {
    let at = this.moment >= 100 ? 0 : this.moment;
    this.animate((seconds) => {
      at = Math.min(100, at + seconds * (still.matches ? 10 : 16));
      this.moment = at;
      this.setTime(Math.round(at));
      this.paint();
      return at < 100;
    });
  }

  drawTube(context, width, height) {
    if (!this.device?.model.late) return;
    const { tube, Le, tau_99, t_pore } = this.device.model;
    const given = this.given();
    const [tau, [w, own]] = [this.tau(), conserving(tube, tau_99)];
    const c = Math.cbrt(tube.Phi_inf) * w * frontSpeed(Le, delayed(tau, own)[0]);
    const { profile } = travellingWave(tube.M, tube.Pi_ratio, tube.Phi_inf, c, true);
    const [millimetre, micrometre] = [1e3 * given.heated_length, 1e6 * given.a_1];
    const front = frontAt(Le, tau) * millimetre;
    const near = 8 * w * millimetre;
    const range = this.control("near").checked ? [front - near, front + near] : [0, 1.12 * millimetre];
    const at = axes(context, width, height, {
      x: linear(...range), y: linear(-1.14 * micrometre, 1.14 * micrometre), xLabel: "axial position z (mm)", yLabel: "radius (µm)", top: 26, left: 62,
    });
    clipped(context, at.box, () => {
      // the wave has no end, the tube has one
      const inside = profile.Z.map((z, i) => [front + z * w * millimetre, profile.Phi[i]]).filter(([z]) => z > range[0]);
      const [Z, Phi1] = [inside.map(([z]) => z), inside.map(([, Phi]) => Phi)];
      drawWall(context, at, { Z, Phi1, Phi_inf: tube.Phi_inf, ends: range, radii: [micrometre, tube.ell * micrometre] });
      line(context, at, [front, front], [-2 * micrometre, 2 * micrometre], { colour: data.colours.nonlinear, width: 1.4, dash: [6, 4] });
      words(context, "front", at.x(front) - 5, at.box.top + 10, { colour: themed("ink"), align: "right" });
      const start = Math.min(at.x(front) + 24, at.box.right - 70);
      arrow(context, start, at.y(0), 46, 0, { colour: themed("link"), width: 2.4 });
    });
    shadeBar(context, Math.max(100, at.box.left + 34), 6, 90, "1", printed(tube.Phi_inf, 3), "polymer fraction Φ₁");
    if (width > 520) words(context, withUnit(tau * t_pore, "s", 3), at.box.right, 10, { colour: themed("soft"), align: "right" });
  }

  wanted() {
    const of = (key) => Number(this.fields.get(key).number.value) * this.fields.get(key).factor;
    return { time: of("wanted_time") || Infinity, volume: of("wanted_volume"), wall: of("wanted_wall"), light: this.control("light").value };
  }

  // Scan a few designs at a time, so that nothing waits for it.
  ask() {
    clearTimeout(this.scanning);
    this.points = this.front = undefined;
    this.element.querySelector("[data-scan]").hidden = !this.device;
    if (!this.device) return;
    const given = this.given();
    const scan = scanned(given, this.wanted());
    const points = [];
    const go = () => {
      const until = performance.now() + 12;
      while (performance.now() < until) {
        const { value, done } = scan.next();
        if (done) return this.answer(points);
        points.push(value);
      }
      this.scanning = setTimeout(go, 0);
    };
    this.scanning = setTimeout(go, 250);
  }

  answer(points) {
    this.points = points;
    const feasible = points.filter((each) => each.feasible);
    this.front = pareto(feasible);
    const unknown = points.filter((each) => Number.isNaN(each.volume)).length;
    this.element.querySelector("[data-answer]").textContent =
      `${feasible.length} of ${points.length} designs do what is wanted, ${this.front.length} of them cannot be bettered in both time and volume.` +
      (unknown ? ` ${unknown} have no late pulse and were left out.` : "");
    const shown = this.front.filter((_, i) => i % Math.ceil(this.front.length / 8) === 0);
    this.element.querySelector("[data-front]").replaceChildren(...shown.map((point) => this.choice(point)));
    this.element.dataset.scanned = points.length;
    this.paint();
  }

  choice(point) {
    const row = document.createElement("tr");
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: "Take" });
    button.setAttribute("aria-label", `Take the design with a_1 = ${withUnit(point.a_1, "m", 3)} and ell = ${printed(point.ell, 3)}`);
    button.addEventListener("click", () => {
      this.set("a_1", point.a_1);
      this.set("a_0", point.ell * point.a_1);
      this.changed();
    });
    for (const text of [withUnit(point.a_1, "m", 3), printed(point.ell, 3), withUnit(point.wall, "m", 3), withUnit(point.time, "s", 3), withUnit(point.volume, "m^3", 3)]) {
      row.insertCell().textContent = text;
    }
    row.insertCell().append(button);
    return row;
  }

  drawPlane(context, width, height) {
    if (!this.points) return;
    const given = this.given();
    const centre = 1e6 * given.a_1;
    const step = SCAN.around ** (1 / (SCAN.a_1 - 1));
    const at = axes(context, width, height, {
      x: logarithmic(centre / SCAN.around, centre * SCAN.around), y: linear(0.0375, 0.9625), xLabel: "outer radius a₁ (µm)", yLabel: "ℓ = a₀/a₁", right: 26,
    });
    clipped(context, at.box, () => {
      for (const point of this.points) {
        if (!point.feasible) continue;
        const [left, right] = [1e6 * point.a_1 / step, 1e6 * point.a_1 * step].map(at.x);
        const [bottom, top] = [point.ell - 0.0125, point.ell + 0.0125].map(at.y);
        context.fillStyle = isDark() ? "#2f5d46" : "#bfe3cf";
        context.fillRect(left, top, right - left + 0.5, bottom - top + 0.5);
      }
      for (const point of this.front) dot(context, at.x(1e6 * point.a_1), at.y(point.ell), { colour: themed("link"), size: 3 });
      dot(context, at.x(centre), at.y(given.a_0 / given.a_1), { colour: themed("ink"), fill: themed("paper"), size: 5, square: true });
    });
  }

  drawPareto(context, width, height) {
    if (!this.points) return;
    const known = this.points.filter((each) => each.volume > 0);
    if (!known.length) return;
    const span = (values) => [smallest(values) / 1.3, largest(values) * 1.3];
    const volumeUnit = (value) => value / 1e-12;
    const at = axes(context, width, height, {
      x: logarithmic(...span(known.map((each) => each.time))), y: logarithmic(...span(known.map((each) => volumeUnit(each.volume)))), xLabel: "response time t₉₉ (s)", yLabel: "pumped (nL)", left: 62, right: 22,
    });
    clipped(context, at.box, () => {
      for (const each of known) {
        context.fillStyle = each.feasible ? (isDark() ? "#3f8f66" : "#6dbb90") : themed("line");
        context.fillRect(at.x(each.time) - 1.5, at.y(volumeUnit(each.volume)) - 1.5, 3, 3);
      }
      line(context, at, this.front.map((each) => each.time), this.front.map((each) => volumeUnit(each.volume)), { colour: themed("link"), width: 2 });
      for (const each of this.front) dot(context, at.x(each.time), at.y(volumeUnit(each.volume)), { colour: themed("link"), size: 3 });
      const { numbers, model } = this.device;
      if (model.late) {
        dot(context, at.x(numbers.response_time[0]), at.y(volumeUnit(numbers.final_pumped_volume_conserving[0])), { colour: themed("ink"), fill: themed("paper"), size: 5, square: true });
      }
    });
  }
}
