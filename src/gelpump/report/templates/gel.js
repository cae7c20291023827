// A gel between its equilibria: osmotic pressure, and the plane of temperature and polymer fraction.
const GEL_SECONDS = 6; // one way
const GEL_STEP = 0.05; // kelvin

class GelExplorer extends Explorer {
  constructor() {
    super("explore-gel");
    this.gels = {};
    for (const [name, packed] of Object.entries(data.gels)) {
      const gel = { ...packed };
      for (const key of ["phi", "T_equilibrium", "T_spinodal", "Pi_coldest", "Pi_hottest"]) gel[key] = unpack(packed[key]);
      this.gels[name] = gel;
    }
    this.control("gel").addEventListener("change", (event) => {
      this.pause();
      this.choose(event.target.value);
    });
    const names = Object.keys(this.gels);
    const pumped = names.find((name) => Object.values(data.beads).some((bead) => bead.gel === name));
    this.control("gel").value = pumped || names[0];
    this.choose(this.control("gel").value);
    this.canvas("pressure", (...all) => this.drawPressure(...all));
    this.canvas("plane", (...all) => this.drawPlane(...all));
  }

  choose(name) {
    const gel = (this.gel = this.gels[name]);
    this.name = name;
    this.cold = gel.temperature[0];
    this.hot = gel.temperature[gel.temperature.length - 1];
    const count = Math.round((this.hot - this.cold) / GEL_STEP) + 1;
    this.beads = Object.entries(data.beads).filter(([, bead]) => bead.gel === name);
    const start = Math.round(count * 0.3);
    const fresh = this.control("T").cloneNode();
    this.control("T").replaceWith(fresh);
    this.setTemperature = this.slider("T", count, start, (i) => `${this.kelvin(i).toFixed(2)} K`, (i) => this.go(i));
    this.branch = 0;
    this.trail = [];
    const [up, down] = gel.fold_T.length > 1 ? [smallest(gel.fold_T), largest(gel.fold_T)] : [undefined, undefined];
    this.number("fold-up", up === undefined ? "no jump" : `${up.toFixed(3)} K`);
    this.number("fold-down", down === undefined ? "no jump" : `${down.toFixed(3)} K`);
    this.go(start);
  }

  kelvin(index) {
    return this.cold + index * GEL_STEP;
  }

  // Polymer fractions in equilibrium at T, between the stored ones, and whether each is stable.
  equilibria(T) {
    const { phi, T_equilibrium, stable } = this.gel;
    const found = [];
    for (let i = 1; i < phi.length; i++) {
      const [a, b] = [T_equilibrium[i - 1] - T, T_equilibrium[i] - T];
      if (a * b < 0 || b === 0) found.push({ phi: phi[i - 1] + ((phi[i] - phi[i - 1]) * a) / (a - b), stable: Boolean(stable[i - 1] && stable[i]) });
    }
    return found;
  }

  go(index) {
    this.index = index;
    const T = (this.T = this.kelvin(index));
    this.all = this.equilibria(T);
    const stable = this.all.filter((each) => each.stable).map((each) => each.phi);
    const nearest = stable.reduce((best, phi) => (Math.abs(phi - this.branch) < Math.abs(best - this.branch) ? phi : best), stable[0]);
    if (nearest !== undefined) {
      this.branch = nearest;
      this.trail.push([T, nearest]);
      if (this.trail.length > 700) this.trail.shift();
    }
    this.number("phi_0", nearest === undefined ? "none" : printed(nearest));
    this.number("others", stable.filter((phi) => phi !== nearest).map((phi) => printed(phi)).join(", ") || "none");
    const inside = this.unstable(T);
    this.number("spinodal", inside ? `${printed(inside[0], 3)} to ${printed(inside[1], 3)}` : "nowhere");
    this.paint();
  }

  // The widest range of polymer fractions with D < 0 at T.
  unstable(T) {
    const { phi, T_spinodal, falls } = this.gel;
    let range;
    for (let i = 0; i < phi.length; i++) {
      if (falls[i] ? T > T_spinodal[i] : T < T_spinodal[i]) range = range ? [range[0], phi[i]] : [phi[i], phi[i]];
    }
    return range;
  }

  play() {
    const last = Math.round((this.hot - this.cold) / GEL_STEP);
    let position = this.index;
    let way = position >= last ? -1 : 1;
    this.trail = [];
    this.animate((seconds) => {
      position += way * (still.matches ? (seconds ? last / 20 : 0) : (seconds / GEL_SECONDS) * last);
      if (position >= last) [position, way] = [last, -1];
      if (position <= 0 && way < 0) position = 0;
      // every step between, so that the branch is not lost
      const target = Math.round(position);
      const step = Math.sign(target - this.index);
      while (this.index !== target) this.go(this.index + step);
      this.setTemperature(this.index);
      return !(position === 0 && way < 0);
    });
  }

  pressure(i) {
    const share = (this.T - this.cold) / (this.hot - this.cold);
    return this.gel.Pi_coldest[i] + share * (this.gel.Pi_hottest[i] - this.gel.Pi_coldest[i]);
  }

  drawPressure(context, width, height) {
    const { phi, Pi_coldest, Pi_hottest } = this.gel;
    const low = Math.min(smallest(Pi_coldest), smallest(Pi_hottest));
    const most = largest(this.gels[this.name].T_equilibrium.map((T, i) => (T > this.cold && T < this.hot ? phi[i] : 0)));
    const at = axes(context, width, height, {
      x: linear(0, Math.min(1, 1.25 * most)), y: linear(1.3 * low, -2.2 * low), xLabel: "polymer fraction φ", yLabel: "osmotic pressure Π (k_{B}T/Ω_{f})", left: 66,
    });
    this.drawCurves(context, at);
    words(context, `${this.name}, ${this.T.toFixed(2)} K`, at.box.left + 10, at.box.top + 15, { colour: themed("link"), size: 14 });
    this.drawNear(context, at.box);
  }

  drawCurves(context, at) {
    const { phi, Pi_coldest, Pi_hottest } = this.gel;
    clipped(context, at.box, () => {
      line(context, at, [0, 1], [0, 0], { colour: themed("soft"), width: 1 });
      const xs = Array.from(phi);
      line(context, at, xs, Array.from(Pi_coldest), { colour: themed("line"), width: 1.4 });
      line(context, at, xs, Array.from(Pi_hottest), { colour: themed("line"), width: 1.4 });
      line(context, at, xs, xs.map((_, i) => this.pressure(i)), { colour: themed("link"), width: 2.2 });
      for (const each of this.all) {
        const here = each.phi === this.branch;
        dot(context, at.x(each.phi), at.y(0), { colour: themed(here ? "deviates" : "ink"), fill: each.stable ? themed(here ? "deviates" : "ink") : themed("paper"), size: here ? 5.5 : 3.6 });
      }
    });
  }

  // The pressure about the equilibrium, magnified: a swollen gel's is a hundred times smaller.
  drawNear(context, { left, right, top, bottom }) {
    const [low, high] = [0.3 * this.branch, Math.min(1.7 * this.branch, 0.99)];
    const near = Array.from(this.gel.phi, (phi, i) => (phi > low && phi < high ? Math.abs(this.pressure(i)) : 0));
    const most = largest(near);
    if (!(most > 0)) return;
    const power = 10 ** Math.floor(Math.log10(most));
    const size = [1, 2, 5, 10].map((factor) => factor * power).find((each) => each >= most);
    const [x, y] = [left + 12, top + 28];
    const [width, height] = [Math.min(0.56 * (right - left), 220), 0.4 * (bottom - top)];
    context.save();
    context.translate(x, y);
    context.fillStyle = themed("paper");
    context.fillRect(0, 0, width, height);
    const at = axes(context, width, height, { x: linear(low, high), y: linear(-size, size), xLabel: "", yLabel: "", left: 58, bottom: 20, top: 4, right: 8 });
    this.drawCurves(context, at);
    context.restore();
  }

  drawPlane(context, width, height) {
    const { phi, T_equilibrium, T_spinodal, stable, falls } = this.gel;
    const most = largest(T_equilibrium.map((T, i) => (T > this.cold && T < this.hot ? phi[i] : 0)));
    const at = axes(context, width, height, {
      x: linear(this.cold, this.hot), y: linear(0, Math.min(1, 1.12 * most)), xLabel: "temperature T (K)", yLabel: "polymer fraction φ",
    });
    clipped(context, at.box, () => {
      context.fillStyle = isDark() ? "#33383f" : "#e3e0da";
      for (let i = 1; i < phi.length; i++) {
        const edge = Math.max(this.cold, Math.min(this.hot, T_spinodal[i]));
        const [from, to] = falls[i] ? [edge, this.hot] : [this.cold, edge];
        if (from < to) context.fillRect(at.x(from), at.y(phi[i]), at.x(to) - at.x(from), at.y(phi[i - 1]) - at.y(phi[i]) + 0.6);
      }
      this.beads.forEach(([, bead], i) => {
        const lens = bead.models.lens;
        const fractions = [...lens.surface.slice(1), ...lens.centre];
        context.globalAlpha = 0.4;
        line(context, at, [bead.to, bead.to], [smallest(fractions), largest(fractions)], { colour: data.colours.cases[i % 3], width: 7 });
        context.globalAlpha = 1;
        line(context, at, [bead.from, bead.to], [lens.centre[0], lens.centre[0]], { colour: data.colours.cases[i % 3], width: 1.6 });
      });
      const [xs, ys] = [Array.from(T_equilibrium), Array.from(phi)];
      line(context, at, xs, ys.map((value, i) => (stable[i] ? value : NaN)), { colour: themed("ink"), width: 1.7 });
      line(context, at, xs, ys.map((value, i) => (stable[i] ? NaN : value)), { colour: themed("ink"), width: 1.4, dash: [2, 3] });
      if (this.trail.length > 1) line(context, at, this.trail.map((each) => each[0]), this.trail.map((each) => each[1]), { colour: themed("deviates"), width: 2.6 });
      line(context, at, [this.T, this.T], [0, 1], { colour: themed("soft"), width: 1 });
      dot(context, at.x(this.T), at.y(this.branch), { colour: themed("deviates"), size: 5.5 });
    });
    words(context, "D < 0", at.box.right - 12, at.y(0.45 * most), { colour: themed("soft"), align: "right", size: 14 });
  }
}
