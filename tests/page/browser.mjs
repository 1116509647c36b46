// Chromium without a window, driven over two pipes: nothing but Node is needed.
import { spawn } from 'node:child_process';

export class Browser {
  #id = 0;
  #waiting = new Map();
  #listeners = [];
  #rest = '';

  constructor(program) {
    this.process = spawn(
      program,
      ['--headless=new', '--remote-debugging-pipe', '--no-sandbox', '--disable-gpu', '--no-first-run',
       '--disable-dev-shm-usage', '--hide-scrollbars', '--disable-background-networking', 'about:blank'],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.process.on('exit', () => this.#fail(new Error('the browser has ended')));
    this.process.on('error', (error) => this.#fail(error));
    this.process.stdio[3].on('error', () => {});
    this.process.stdio[4].setEncoding('utf8').on('data', (text) => {
      const messages = (this.#rest + text).split('\0');
      this.#rest = messages.pop();
      for (const message of messages) this.#receive(JSON.parse(message));
    });
  }

  #fail(error) {
    this.failure = error;
    for (const { reject } of this.#waiting.values()) reject(error);
    this.#waiting.clear();
  }

  #receive(message) {
    const call = this.#waiting.get(message.id);
    if (call) {
      this.#waiting.delete(message.id);
      message.error ? call.reject(new Error(message.error.message)) : call.resolve(message.result);
    } else {
      this.#listeners = this.#listeners.filter((listener) => !listener(message));
    }
  }

  send(method, params = {}) {
    if (this.failure) return Promise.reject(this.failure);
    const id = ++this.#id;
    this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.session }) + '\0');
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  #event(method) {
    return new Promise((resolve) => this.#listeners.push((message) => message.method === method && (resolve(), true)));
  }

  /** Opens a page and waits until it is loaded. */
  async open(url) {
    if (!this.session) {
      const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
      const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
      this.session = sessionId;
      await this.send('Page.enable');
    }
    const loaded = this.#event('Page.loadEventFired');
    const { errorText } = await this.send('Page.navigate', { url });
    if (errorText) throw new Error(`${url}: ${errorText}`);
    await loaded;
  }

  /** The value of an expression in the page, awaited. */
  async value(expression) {
    const { result, exceptionDetails } =
      await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  async show(width, scheme) {
    await this.send('Emulation.setDeviceMetricsOverride', { width, height: 900, deviceScaleFactor: 1, mobile: false });
    await this.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: scheme }] });
  }

  async close() {
    this.session = undefined;
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    this.send('Browser.close').catch(() => {});
    const late = setTimeout(() => this.process.kill('SIGKILL'), 5000);
    await ended;
    clearTimeout(late);
  }
}
