// Before anything of the page: whatever goes wrong is kept, for page_check.js to tell.
'use strict';

const failures = [];
const fail = text => failures.push(text);
window.addEventListener('error', event => fail(`error: ${event.message}`));
window.addEventListener('unhandledrejection', event => fail(`rejection: ${event.reason}`));
window.addEventListener('securitypolicyviolation', event => fail(`fetched: ${event.blockedURI}`));
