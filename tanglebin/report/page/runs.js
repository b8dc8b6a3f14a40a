// All runs of an experiment, which runs_section.cpp wrote as columns: two plots of the runs that the reader chooses, and
// a table of them that any column sorts.
"use strict";

(() => {
  const ROWS_ON_A_PAGE = 20;
  const HISTOGRAM_BARS = 20;
  const METHOD_COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a63d2"];  // Okabe and Ito 2008
  const METHOD_MARKS = ["circle", "triangle", "rect", "rectRot", "star"];

  const share = value => value.toFixed(4);
  const count = value => value.toFixed(2).replace(/\.00$/, "");
  const MEASURES = {
    micro_recall: ["micro-recall", share],
    mean_iou: ["mean IoU", share],
    f1: ["F1", share],
    panoptic_quality: ["panoptic quality", share],
    adjusted_rand_index: ["adjusted Rand index", share],
    unmixed_recall: ["micro-recall without mixed points", share],
    centre_line_error: ["centre-line error, mm", value => value.toFixed(2)],
    joins_missed: ["joins missed", count],
    joins_wrong: ["joins wrong", count],
    seconds: ["seconds", value => value.toFixed(3)],
  };
  const KEYS = { set: ["set", String], tubes: ["tubes", count], case: ["case", count], scanner: ["scanner", String],
                 method: ["method", String], ratio: ["ratio", String] };
  const NAMES = ["set", "scanner"];  // words; a plot has them side by side
  const FILTERS = ["set", "scanner", "method", "tubes", "ratio"];
  const fewDigits = value => String(Number(value.toPrecision(4)));

  function element(name, properties = {}, ...children) {
    const result = Object.assign(document.createElement(name), properties);
    result.append(...children);
    return result;
  }

  const byValue = (a, b) => a < b ? -1 : a > b ? 1 : 0;
  const distinct = values => [...new Set(values)].sort(byValue);
  const mean = values => values.reduce((sum, value) => sum + value, 0) / values.length;

  function choice(text, options, value) {
    const select = element("select", {}, ...options.map(([option, title]) => new Option(title, option)));
    select.value = value;
    return { select, label: element("label", {}, text, select) };
  }

  class Runs {
    constructor(root) {
      const { drawn, ...columns } = JSON.parse(root.querySelector("script").textContent);
      this.columns = { ...columns, ...drawn };
      this.kinds = { ...KEYS, ...MEASURES };
      this.measures = Object.keys(MEASURES).filter(name => columns[name].some(value => value !== null));
      for (const name of Object.keys(drawn)) this.kinds[name] = [name, fewDigits];
      if (columns.scanner.every(name => name === "")) delete this.kinds.scanner;
      this.variables = ["tubes", "ratio", ...NAMES.filter(name => name in this.kinds), ...Object.keys(drawn), "case",
                        ...this.measures];
      this.columns.centre_line_error = this.columns.centre_line_error.map(metres => metres === null ? null : 1000 * metres);
      this.size = this.columns.set.length;
      this.methods = distinct(this.columns.method);
      this.sortedBy = "micro_recall";
      this.isAscending = true;
      this.page = 0;
      this.addElements(root);
      this.plots = this.newPlots();
      this.choose();
      matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.plot());
    }

    titled(name) { return this.kinds[name][0]; }

    shown(name, value) { return value === null ? "–" : this.kinds[name][1](value); }

    addElements(root) {
      const listed = names => names.map(name => [name, this.titled(name)]);
      this.measure = choice("Plot", listed(this.measures), "micro_recall");
      this.variable = choice("against", listed(this.variables), "tubes");
      this.filters = FILTERS.filter(name => name in this.kinds).map(name => ({ name, ...choice(this.titled(name),
        [["", "all"], ...distinct(this.columns[name]).map(value => [value, String(value)])], "") }));
      for (const { select } of [this.measure, this.variable]) select.addEventListener("change", () => this.plot());
      for (const { select } of this.filters) select.addEventListener("change", () => this.choose());
      this.scatter = element("canvas");
      this.histogram = element("canvas");
      for (const canvas of [this.scatter, this.histogram]) canvas.setAttribute("role", "img");
      this.head = element("tr");
      this.body = element("tbody");
      this.place = element("output");
      this.previous = element("button", { type: "button", textContent: "previous" });
      this.next = element("button", { type: "button", textContent: "next" });
      this.previous.addEventListener("click", () => this.turnTo(this.page - 1));
      this.next.addEventListener("click", () => this.turnTo(this.page + 1));
      const table = element("table", {}, element("thead", {}, this.head), this.body);
      root.replaceChildren(
        element("div", { className: "runs-choices" },
                ...[this.measure, this.variable, ...this.filters].map(({ label }) => label)),
        element("div", { className: "runs-plots" }, element("div", {}, this.scatter), element("div", {}, this.histogram)),
        element("div", { className: "scroll", tabIndex: 0 }, table),
        element("div", { className: "runs-pages" }, this.place, this.previous, this.next));
    }

    // ---- Which runs count

    choose() {
      const chosen = this.filters.filter(({ select }) => select.value !== "");
      const isChosen = i => chosen.every(({ name, select }) => String(this.columns[name][i]) === select.value);
      this.runs = [];
      for (let i = 0; i < this.size; ++i) if (isChosen(i)) this.runs.push(i);
      this.sort();
      this.plot();
    }

    // Runs without a value come last.
    sort() {
      const values = this.columns[this.sortedBy];
      const sign = this.isAscending ? 1 : -1;
      this.runs.sort((a, b) => (values[a] === null) - (values[b] === null) || sign * byValue(values[a], values[b]) || a - b);
      this.turnTo(0);
    }

    sortBy(name) {
      this.isAscending = name === this.sortedBy ? !this.isAscending : true;
      this.sortedBy = name;
      this.sort();
    }

    // ---- The table

    turnTo(page) {
      const last = Math.max(0, Math.ceil(this.runs.length / ROWS_ON_A_PAGE) - 1);
      this.page = Math.min(Math.max(page, 0), last);
      const first = this.page * ROWS_ON_A_PAGE;
      const rows = this.runs.slice(first, first + ROWS_ON_A_PAGE);
      this.head.replaceChildren(element("td"), ...Object.keys(this.kinds).map(name => this.heading(name)));
      this.body.replaceChildren(...rows.map(i => this.row(i)));
      this.place.value = rows.length === 0 ? "no runs" :
        `runs ${first + 1} to ${first + rows.length} of ${this.runs.length.toLocaleString("en")}`;
      this.previous.disabled = this.page === 0;
      this.next.disabled = this.page === last;
    }

    heading(name) {
      const button = element("button", { type: "button", textContent: this.titled(name) });
      button.addEventListener("click", () => {
        this.sortBy(name);
        this.head.querySelector("[aria-sort] button").focus();
      });
      const cell = element("th", { scope: "col" }, button);
      if (name === this.sortedBy) cell.setAttribute("aria-sort", this.isAscending ? "ascending" : "descending");
      return cell;
    }

    row(i) {
      const cells = Object.keys(this.kinds).map(name => element("td", { textContent: this.shown(name, this.columns[name][i]) }));
      const note = element("td", { textContent: this.columns.failed[i] ? "failed" : "" });
      const scene = this.sceneOf(i);
      if (scene) {
        const button = element("button", { type: "button", textContent: "3D" });
        button.setAttribute("aria-label", `Show ${this.nameOf(i)} in 3D`);
        button.addEventListener("click", () => scene(this.columns.method[i]));
        note.append(button);
      }
      return element("tr", {}, note, ...cells);
    }

    nameOf(i) {
      const scanner = this.columns.scanner[i];
      return `${this.columns.set[i]}${this.columns.tubes[i]}/${this.columns.case[i]}${scanner && `, ${scanner}`}`;
    }

    // Shows the scene of a run with a method's labels; null if it is not there in 3D.
    sceneOf(i) {
      const name = `${this.nameOf(i)}, ratio ${this.columns.ratio[i]}`;
      return document.querySelector(".scene-view")?.opener?.(name) ?? null;
    }

    // ---- The plots

    newPlots() {
      const label = context => context.raw.text ?? `${context.dataset.label}: ${context.formattedValue}`;
      const options = () => ({
        animation: false, maintainAspectRatio: false,
        plugins: { tooltip: { callbacks: { title: () => "", label } }, legend: { labels: { usePointStyle: true, boxHeight: 6 } } },
      });
      return {
        scatter: new Chart(this.scatter, { type: "scatter", data: { datasets: [] }, options: options() }),
        histogram: new Chart(this.histogram, { type: "bar", data: { datasets: [] }, options: options() }),
      };
    }

    plot() {
      const measure = this.measure.select.value;
      const variable = this.variable.select.value;
      const runs = this.runs.filter(i => this.columns[measure][i] !== null && this.columns[variable][i] !== null);
      this.plotScatter(runs, measure, variable);
      this.plotHistogram(runs, measure);
    }

    // Where a variable is on an axis: of words, one beside the other.
    places(variable) {
      if (!NAMES.includes(variable)) return value => value;
      const names = distinct(this.columns[variable]);
      return name => names.indexOf(name);
    }

    // Where the variable has few values, also the means at each.
    plotScatter(runs, measure, variable) {
      const mostMeans = 40;
      const hasMeans = distinct(runs.map(i => this.columns[variable][i])).length <= mostMeans;
      const methods = this.methods.map((name, m) => ({
        name, runs: runs.filter(i => this.columns.method[i] === name), color: METHOD_COLORS[m % METHOD_COLORS.length],
        pointStyle: METHOD_MARKS[m % METHOD_MARKS.length],
      }));
      this.scatter.setAttribute("aria-label",
        `${this.titled(measure)} of ${runs.length} runs against ${this.titled(variable)}. The table below has the numbers.`);
      this.plots.scatter.data.datasets = [
        ...hasMeans ? methods.map(method => this.meansOf(method, measure, variable)) : [],
        ...methods.map(method => this.pointsOf(method, measure, variable)),
      ];
      this.plots.scatter.options.scales = this.axes(this.titled(variable), this.titled(measure));
      if (NAMES.includes(variable)) this.nameTicks(this.plots.scatter.options.scales.x, distinct(this.columns[variable]));
      this.update(this.plots.scatter);
    }

    nameTicks(axis, names) {
      Object.assign(axis, { min: -0.5, max: names.length - 0.5 });
      Object.assign(axis.ticks, { stepSize: 1, autoSkip: false, callback: place => names[place] ?? "" });
      axis.afterBuildTicks = scale => { scale.ticks = names.map((_, value) => ({ value })); };
    }

    meansOf({ name, runs, color, pointStyle }, measure, variable) {
      const placeOf = this.places(variable);
      const valuesAt = new Map();
      for (const i of runs) {
        const place = this.columns[variable][i];
        if (!valuesAt.has(place)) valuesAt.set(place, []);
        valuesAt.get(place).push(this.columns[measure][i]);
      }
      const data = [...valuesAt].sort(([a], [b]) => byValue(a, b)).map(([value, values]) => ({
        x: placeOf(value), y: mean(values),
        text: `${name}, ${this.titled(variable)} ${this.shown(variable, value)}: mean ${this.shown(measure, mean(values))} of ${values.length} runs`,
      }));
      return { label: `${name}, mean`, data, pointStyle, showLine: true, backgroundColor: color, borderColor: color,
               pointRadius: 4, borderWidth: 2 };
    }

    pointsOf({ name, runs, color, pointStyle }, measure, variable) {
      const placeOf = this.places(variable);
      const data = runs.map(i => ({
        x: placeOf(this.columns[variable][i]), y: this.columns[measure][i],
        text: `${this.nameOf(i)}, ${name}, ratio ${this.columns.ratio[i]}: ${this.shown(measure, this.columns[measure][i])}`,
      }));
      const faint = `${color}55`;
      return { label: name, data, pointStyle, backgroundColor: faint, borderColor: faint, pointRadius: 2.5 };
    }

    plotHistogram(runs, measure) {
      const values = runs.map(i => this.columns[measure][i]);
      const low = values.reduce((a, b) => Math.min(a, b), Infinity);
      const high = values.reduce((a, b) => Math.max(a, b), -Infinity);
      const step = (high - low) / HISTOGRAM_BARS || 1;
      const bars = Array.from({ length: HISTOGRAM_BARS }, (_, i) => `${this.shown(measure, low + i * step)}`);
      this.plots.histogram.data = {
        labels: runs.length === 0 ? [] : bars,
        datasets: this.methods.map((method, m) => {
          const counts = new Array(HISTOGRAM_BARS).fill(0);
          for (const i of runs) {
            if (this.columns.method[i] !== method) continue;
            ++counts[Math.min(HISTOGRAM_BARS - 1, Math.floor((this.columns[measure][i] - low) / step))];
          }
          return { label: method, data: counts, backgroundColor: METHOD_COLORS[m % METHOD_COLORS.length], categoryPercentage: 0.95, barPercentage: 1 };
        }),
      };
      this.histogram.setAttribute("aria-label", `Histogram of ${this.titled(measure)} of ${runs.length} runs.`);
      this.plots.histogram.options.scales = this.axes(`${this.titled(measure)}, from`, "runs");
      this.update(this.plots.histogram);
    }

    axes(x, y) {
      const style = getComputedStyle(document.documentElement);
      const color = style.getPropertyValue("--soft").trim();
      const grid = { color: style.getPropertyValue("--line").trim() };
      const axis = text => ({ title: { display: true, text, color }, ticks: { color }, grid });
      return { x: axis(x), y: axis(y) };
    }

    update(plot) {
      plot.options.plugins.legend.labels.color = getComputedStyle(document.documentElement).getPropertyValue("--ink").trim();
      plot.update();
    }
  }

  for (const root of document.querySelectorAll(".runs")) new Runs(root);
})();
