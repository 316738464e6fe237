// Pool of planning workers. The newest live request waits for a free worker; a full plan takes a worker at once.

export class Planner {
  #module;
  #workers = [];
  #waiting = null;

  constructor(module, count) {
    this.#module = module;
    for (let k = 0; k < count; k++) this.#hire();
  }

  /**
   * Plans for the request `wish`. Its callbacks are `progress({stage, done, total, soFar})` for progress, and
   * once `done({answer})` or `done({broken})`.
   */
  plan(wish) {
    this.#waiting = null;
    let worker = this.#workers.find((one) => !one.wish);
    worker ??= this.#replaced(this.#workers.find((one) => !one.wish.whole) ?? this.#workers[0]);
    this.#start(worker, wish);
  }

  /** Plans for `wish` as soon as a worker is free; a newer request replaces a waiting one. */
  planLive(wish) {
    const worker = this.#workers.find((one) => !one.wish);
    if (worker) this.#start(worker, wish);
    else this.#waiting = wish;
  }

  /** Cancels a request; its callbacks are no longer called. */
  cancel(wish) {
    if (this.#waiting === wish) this.#waiting = null;
    const worker = this.#workers.find((one) => one.wish === wish);
    if (worker) this.#replaced(worker);
  }

  #hire() {
    const own = { worker: new Worker('worker.js', { type: 'module' }), wish: null };
    own.worker.addEventListener('message', ({ data }) => this.#heard(own, data));
    own.worker.addEventListener('error', (event) => this.#heard(own, { broken: event.message || 'a worker did not start' }));
    own.worker.postMessage({ module: this.#module });
    this.#workers.push(own);
    return own;
  }

  #replaced(own) {
    own.worker.terminate();
    own.wish = null;
    this.#workers.splice(this.#workers.indexOf(own), 1);
    return this.#hire();
  }

  #start(own, wish) {
    own.wish = wish;
    const { text, file, example, effort, whole } = wish;
    own.worker.postMessage({ text, file, example, effort, whole });
  }

  #heard(own, data) {
    const { wish } = own;
    if (data.ready || !this.#workers.includes(own)) return;
    if ('stage' in data) {
      wish?.progress?.(data);
      return;
    }
    own.wish = null;
    if (data.broken) this.#replaced(own);
    wish?.done(data);
    const free = this.#workers.find((one) => !one.wish);
    if (this.#waiting && free) {
      const next = this.#waiting;
      this.#waiting = null;
      this.#start(free, next);
    }
  }
}
